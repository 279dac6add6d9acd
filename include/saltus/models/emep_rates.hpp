// The rates of EMEP (emep.hpp) at 298 K: constants, the light of a cloudless day at 50 degrees
// north in midsummer, and the humidity. Concentrations are in molecules per cm^3, times in seconds,
// and two-body rates in cm^3/s. Test Set for IVP Solvers, EMEP.
#pragma once

#include <array>

namespace saltus::models::detail {

/// k = factor exp(kelvin / 298).
struct EmepConstant {
  int rate;
  double factor, kelvin;
};
inline constexpr double emep_temperature = 298.0, emep_air = 2.55e19, emep_oxygen = 5.2e18;
/// Rates 1, 5, 7 (with a third body) and 36 (with water) have formulas of their own.
inline constexpr std::array<EmepConstant, 70> emep_constants{
    {{8, 2.2e-10, 0},       {11, 1.8e-12, -1370},   {12, 1.2e-13, -2450}, {13, 1.9e-12, -1000},
     {14, 1.4e-14, -600},   {15, 1.8e-11, 110},     {17, 3.7e-12, 240},   {19, 7.2e-14, -1414},
     {20, 1.4e-12, 0},      {21, 1.4e-11, 0},       {26, 4.1e-16, 0},     {29, 7.1e14, -11080},
     {30, 4.8e-11, 250},    {31, 2.9e-12, -160},    {33, 7.7e-12, -2100}, {35, 1e-14, 785},
     {39, 1.35e-12, 0},     {40, 4e-17, 0},         {43, 1e-4, 0},        {59, 3.9e-12, -1885},
     {60, 4.2e-12, 180},    {61, 5.5e-14, 365},     {62, 5.5e-14, 365},   {63, 3.3e-12, -380},
     {64, 3.2e-12, 0},      {65, 3.8e-13, 780},     {66, 9.6e-12, 0},     {67, 1e-12, 190},
     {68, 1.9e-12, 190},    {69, 5.8e-16, 0},       {70, 2.4e-13, 0},     {71, 7.8e-12, -1020},
     {72, 8.9e-12, 0},      {74, 6.5e-13, 650},     {75, 5.6e-12, 310},   {76, 5.8e-12, 190},
     {77, 1e-11, 0},        {78, 1.34e16, -13330},  {79, 2e-11, 0},       {80, 1.1e-11, 0},
     {81, 1.64e-11, -559},  {85, 1e-11, 0},         {86, 1.15e-12, 0},    {87, 4.8e-12, 0},
     {88, 1.3e-13, 1040},   {89, 3e-13, 1040},      {94, 2.8e-12, 530},   {109, 1.66e-12, 474},
     {112, 1.2e-14, -2630}, {123, 6.5e-15, -1880},  {125, 2.86e-11, 0},   {146, 3.2e-11, 0},
     {147, 2e-11, 0},       {148, 2.2e-11, 0},      {149, 3.7e-11, 0},    {150, 1.23e-14, -2013},
     {151, 2.54e-11, 410},  {153, 4.13e-12, 452},   {156, 2e-11, 0},      {157, 8e-18, 0},
     {158, 1.86e-11, 175},  {160, 4.32e-15, -2016}, {161, 3.35e-11, 0},   {163, 7.8e-13, 0},
     {219, 2e-11, 0},       {221, 1.1e-11, 0},      {222, 1.7e-11, 0},    {223, 2.4e-11, 0},
     {234, 1.37e-11, 0},    {235, 1.7e-11, 0}}};

/// Photolysis n at the secant s of the zenith angle: a exp(-b s) [1/s].
struct EmepLight {
  double a, b;
};
inline constexpr std::array<EmepLight, 16> emep_light{{{1.23e-3, 0.60},
                                                       {2.00e-4, 1.40},
                                                       {1.45e-2, 0.40},
                                                       {2.20e-5, 0.75},
                                                       {3.00e-6, 1.25},
                                                       {5.40e-5, 0.79},
                                                       {6.65e-5, 0.60},
                                                       {1.35e-5, 0.94},
                                                       {2.43e-5, 0.88},
                                                       {5.40e-4, 0.79},
                                                       {2.16e-4, 0.79},
                                                       {5.40e-5, 0.79},
                                                       {3.53e-2, 0.081},
                                                       {8.94e-2, 0.059},
                                                       {3.32e-5, 0.57},
                                                       {2.27e-5, 0.62}}};
/// Each photolysis at night [1/s].
inline constexpr double emep_darkness = 1e-40;

/// Deposition by day [cm/s] into a layer of 1.2e5 cm, numbers 47 to 53; a quarter of it at night.
inline constexpr double emep_layer = 1.2e5;
inline constexpr std::array<double, 7> emep_deposition{0.5, 0.2, 0.5, 0.2, 0.1, 0.5, 0.3};

/// The emission [molecules/(cm^2 s)] of a substance. Hydrocarbons share 2.5e11 by mass.
struct EmepShare {
  int substance;
  double fraction, weight;
};
inline constexpr double emep_emission = 2.5e11;
inline constexpr std::array<EmepShare, 6> emep_hydrocarbons{{{6, 0.07689, 30},
                                                             {7, 0.41444, 58},
                                                             {8, 0.03642, 28},
                                                             {9, 0.03827, 42},
                                                             {10, 0.24537, 106},
                                                             {20, 0.13957, 46}}};
/// NO, SO2, sulphate with it, CO, isoprene, as multiples of that.
struct EmepMultiple {
  int substance;
  double multiple;
};
inline constexpr std::array<EmepMultiple, 5> emep_multiples{
    {{1, 1}, {3, 1}, {21, 0.05}, {4, 10}, {41, 0.5}}};

}  // namespace saltus::models::detail
