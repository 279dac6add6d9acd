// The stiff scenes of the shelf as plain functions, with their Jacobians and their known answers.
// Any program that takes f, J and a tolerance can solve them. Equations, parameters and sources are
// those of saltus/models/.
#pragma once

#include <array>
#include <numbers>
#include <saltus/models/shelf.hpp>

#include "stiff_problems.hpp"

namespace bench {

/// `answer` has the states at some times, which every run is asked for. The error of a component is
/// |x - answer| / (scale + |answer|); the tolerances of a run are rtol and scale * rtol.
struct StiffScene {
  std::string name;
  StiffProblem problem;
  std::vector<saltus::Sample> answer;
  double scale = 1.0;
};

/// Van der Pol in units of mu, 1 / epsilon = mu^2.
template <long mu2>
StiffProblem vdpol() {
  return {.name = "vdpol",
          .start = Eigen::Vector2d(2.0, 0.0),
          .t_end = 2.0,
          .f = [](double, const double* x, double* d,
                  long) { d[0] = x[1], d[1] = ((1.0 - x[0] * x[0]) * x[1] - x[0]) * double(mu2); },
          .jacobian =
              [](double, const double* x, double* j) {
                j[0] = 0.0, j[1] = (-2.0 * x[0] * x[1] - 1.0) * double(mu2);
                j[2] = 1.0, j[3] = (1.0 - x[0] * x[0]) * double(mu2);
              }};
}

inline StiffProblem hires_with_jacobian() {
  StiffProblem problem = hires();
  problem.jacobian = [](double, const double* y, double* out) {
    const double by6 = 280.0 * y[7], by8 = 280.0 * y[5];
    Eigen::Map<Eigen::Matrix<double, 8, 8>>(out) << -1.71, 0.43, 8.32, 0, 0, 0, 0, 0,  //
        1.71, -8.75, 0, 0, 0, 0, 0, 0,                                                 //
        0, 0, -10.03, 0.43, 0.035, 0, 0, 0,                                            //
        0, 8.32, 1.71, -1.12, 0, 0, 0, 0,                                              //
        0, 0, 0, 0, -1.745, 0.43, 0.43, 0,                                             //
        0, 0, 0, 0.69, 1.71, -by6 - 0.43, 0.69, -by8,                                  //
        0, 0, 0, 0, 0, by6, -1.81, by8,                                                //
        0, 0, 0, 0, 0, -by6, 1.81, -by8;
  };
  return problem;
}

inline StiffProblem oregonator() {
  return {.name = "orego",
          .start = Eigen::Vector3d(1.0, 2.0, 3.0),
          .t_end = 360.0,
          .f =
              [](double, const double* y, double* d, long) {
                d[0] = 77.27 * (y[1] + y[0] * (1.0 - 8.375e-6 * y[0] - y[1]));
                d[1] = (y[2] - (1.0 + y[0]) * y[1]) / 77.27, d[2] = 0.161 * (y[0] - y[2]);
              },
          .jacobian =
              [](double, const double* y, double* j) {
                j[0] = 77.27 * (1.0 - 16.75e-6 * y[0] - y[1]), j[1] = -y[1] / 77.27, j[2] = 0.161;
                j[3] = 77.27 * (1.0 - y[0]), j[4] = -(1.0 + y[0]) / 77.27, j[5] = 0.0;
                j[6] = 0.0, j[7] = 1.0 / 77.27, j[8] = -0.161;
              }};
}

inline StiffProblem e5() {
  return {.name = "e5",
          .start = Eigen::Vector4d(1.76e-3, 0.0, 0.0, 0.0),
          .t_end = 1e13,
          .f =
              [](double, const double* y, double* d, long) {
                const double decay = 7.89e-10 * y[0], on = 1.1e7 * y[0] * y[2];
                d[0] = -decay - on, d[1] = decay - 1.13e9 * y[1] * y[2];
                d[3] = on - 1.13e3 * y[3], d[2] = d[1] - d[3];
              },
          .jacobian =
              [](double, const double* y, double* out) {
                constexpr double a = 7.89e-10, c = 1.13e3;
                const double by1 = 1.1e7 * y[2], by3 = 1.1e7 * y[0], mcy2 = 1.13e9 * y[2],
                             mcy3 = 1.13e9 * y[1];
                Eigen::Map<Eigen::Matrix4d>(out) << -a - by1, 0.0, -by3, 0.0,  //
                    a, -mcy2, -mcy3, 0.0,                                      //
                    a - by1, -mcy2, -mcy3 - by3, c,                            //
                    by1, 0.0, by3, -c;
              }};
}

/// Reactions of POLLU: the rate, one or two substances that react, up to three products; 0: none.
struct Reaction {
  double k;
  int a, b;
  std::array<int, 3> to;
};
inline constexpr std::array<Reaction, 25> reactions{
    {{0.35, 1, 0, {2, 3, 0}},     {26.6, 2, 4, {1, 0, 0}},     {1.23e4, 5, 2, {1, 6, 0}},
     {8.6e-4, 7, 0, {5, 5, 8}},   {8.2e-4, 7, 0, {8, 0, 0}},   {1.5e4, 7, 6, {5, 8, 0}},
     {1.3e-4, 9, 0, {10, 5, 8}},  {2.4e4, 9, 6, {11, 0, 0}},   {1.65e4, 11, 2, {1, 10, 12}},
     {9e3, 11, 1, {13, 0, 0}},    {0.022, 13, 0, {11, 1, 0}},  {1.2e4, 10, 2, {14, 1, 0}},
     {1.88, 14, 0, {7, 5, 0}},    {1.63e4, 1, 6, {15, 0, 0}},  {4.8e6, 3, 0, {4, 0, 0}},
     {3.5e-4, 4, 0, {16, 0, 0}},  {0.0175, 4, 0, {3, 0, 0}},   {1e8, 16, 0, {6, 6, 0}},
     {4.44e11, 16, 0, {3, 0, 0}}, {1240.0, 17, 6, {18, 5, 0}}, {2.1, 19, 0, {2, 0, 0}},
     {5.78, 19, 0, {1, 3, 0}},    {0.0474, 1, 4, {19, 0, 0}},  {1780.0, 19, 1, {20, 0, 0}},
     {3.12, 20, 0, {19, 1, 0}}}};

/// Adds what a reaction of this rate changes in a second.
inline void react(const Reaction& r, double rate, double* d) {
  d[r.a - 1] -= rate;
  if (r.b > 0) d[r.b - 1] -= rate;
  for (const int i : r.to)
    if (i > 0) d[i - 1] += rate;
}

inline StiffProblem pollu() {
  Eigen::VectorXd start = Eigen::VectorXd::Zero(20);
  start[1] = 0.2, start[3] = 0.04, start[6] = 0.1, start[7] = 0.3, start[8] = 0.01;
  start[16] = 0.007;
  return {.name = "pollu",
          .start = start,
          .t_end = 60.0,
          .f =
              [](double, const double* y, double* d, long n) {
                std::fill_n(d, n, 0.0);
                for (const Reaction& r : reactions)
                  react(r, r.k * y[r.a - 1] * (r.b > 0 ? y[r.b - 1] : 1.0), d);
              },
          .jacobian =
              [](double, const double* y, double* out) {
                std::fill_n(out, 400, 0.0);
                for (const Reaction& r : reactions) {
                  react(r, r.k * (r.b > 0 ? y[r.b - 1] : 1.0), out + 20 * (r.a - 1));
                  if (r.b > 0) react(r, r.k * y[r.a - 1], out + 20 * (r.b - 1));
                }
              }};
}

}  // namespace bench
