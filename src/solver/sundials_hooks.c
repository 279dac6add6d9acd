/* Built with the SUNDIALS wheel only. That wheel is made for Python, and its static libraries free tables of Python callbacks
 * through the functions below, which live in its Python module. We never load that module, so there is nothing to free. They
 * are weak: a program that does have the real ones keeps them. */
#define SALTUS_HOOK(name) \
  void name(void* table); \
  __attribute__((weak)) void name(void* table) { (void)table; }

SALTUS_HOOK(SUNContextFunctionTable_Destroy)
SALTUS_HOOK(SUNLoggerFunctionTable_Destroy)
SALTUS_HOOK(SUNStepperFunctionTable_Destroy)
SALTUS_HOOK(SUNLinearSolverFunctionTable_Destroy)
SALTUS_HOOK(SUNNonlinearSolverFunctionTable_Destroy)
SALTUS_HOOK(SUNDomEigEstimatorFunctionTable_Destroy)
SALTUS_HOOK(SUNAdjointStepperFunctionTable_Destroy)
SALTUS_HOOK(cvode_user_supplied_fn_table_destroy)
