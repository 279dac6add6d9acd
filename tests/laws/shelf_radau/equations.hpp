// The equations of the shelf in binary128, their decimal constants exact, and their starts: written
// apart from the headers of the scenes, so that an error in one of the two shows.
#pragma once

#include <map>

#include "emep.hpp"
#include "fields.hpp"

inline const Equation robertson = [](Quad, const Vector& y, Vector& d) {
  const Quad a = number("0.04") * y[0], b = 10000 * y[1] * y[2], c = 30000000 * y[1] * y[1];
  d[0] = b - a, d[1] = a - b - c, d[2] = c;
};
inline const Equation hires = [](Quad, const Vector& y, Vector& d) {
  static const Quad a = number("1.71"), b = number("0.43"), c = number("8.32"),
                    e = number("0.0007"), f = number("8.75"), g = number("10.03"),
                    h = number("0.035"), i = number("1.12"), j = number("1.745"),
                    k = number("0.69"), l = number("1.81");
  d[0] = -a * y[0] + b * y[1] + c * y[2] + e;
  d[1] = a * y[0] - f * y[1];
  d[2] = -g * y[2] + b * y[3] + h * y[4];
  d[3] = c * y[1] + a * y[2] - i * y[3];
  d[4] = -j * y[4] + b * (y[5] + y[6]);
  Quad r = 280 * y[5] * y[7];
  d[5] = -r + k * y[3] + a * y[4] - b * y[5] + k * y[6];
  d[6] = r - l * y[6];
  d[7] = -d[6];
};
inline const Equation orego = [](Quad, const Vector& y, Vector& d) {
  static const Quad s = number("77.27"), q = number("8.375e-6"), w = number("0.161");
  d[0] = s * (y[1] + y[0] * (1 - q * y[0] - y[1]));
  d[1] = (y[2] - (1 + y[0]) * y[1]) / s;
  d[2] = w * (y[0] - y[2]);
};
inline const Equation e5 = [](Quad, const Vector& y, Vector& d) {
  static const Quad A = number("7.89e-10"), B = number("1.1e7"), CM = number("1.13e9"),
                    C = number("1.13e3");
  Quad a = A * y[0], b = B * y[0] * y[2], c = CM * y[1] * y[2], e = C * y[3];
  d[0] = -a - b;
  d[1] = a - c;
  d[3] = b - e;
  d[2] = a - c - b + e;
};
inline const Equation pollu = [](Quad, const Vector& y, Vector& f) {
  static const Quad k[26] = {0,
                             number(".35"),
                             number("26.6"),
                             number("12300"),
                             number(".86e-3"),
                             number(".82e-3"),
                             number("15000"),
                             number(".13e-3"),
                             number("24000"),
                             number("16500"),
                             number("9000"),
                             number(".022"),
                             number("12000"),
                             number("1.88"),
                             number("16300"),
                             number("4.8e6"),
                             number(".35e-3"),
                             number(".0175"),
                             number("1e8"),
                             number(".444e12"),
                             number("1240"),
                             number("2.1"),
                             number("5.78"),
                             number(".0474"),
                             number("1780"),
                             number("3.12")};
  Quad r[26] = {0,
                k[1] * y[0],
                k[2] * y[1] * y[3],
                k[3] * y[4] * y[1],
                k[4] * y[6],
                k[5] * y[6],
                k[6] * y[6] * y[5],
                k[7] * y[8],
                k[8] * y[8] * y[5],
                k[9] * y[10] * y[1],
                k[10] * y[10] * y[0],
                k[11] * y[12],
                k[12] * y[9] * y[1],
                k[13] * y[13],
                k[14] * y[0] * y[5],
                k[15] * y[2],
                k[16] * y[3],
                k[17] * y[3],
                k[18] * y[15],
                k[19] * y[15],
                k[20] * y[16] * y[5],
                k[21] * y[18],
                k[22] * y[18],
                k[23] * y[0] * y[3],
                k[24] * y[18] * y[0],
                k[25] * y[19]};
  f[0] = -r[1] - r[10] - r[14] - r[23] - r[24] + r[2] + r[3] + r[9] + r[11] + r[12] + r[22] + r[25];
  f[1] = -r[2] - r[3] - r[9] - r[12] + r[1] + r[21];
  f[2] = -r[15] + r[1] + r[17] + r[19] + r[22];
  f[3] = -r[2] - r[16] - r[17] - r[23] + r[15];
  f[4] = -r[3] + 2 * r[4] + r[6] + r[7] + r[13] + r[20];
  f[5] = -r[6] - r[8] - r[14] - r[20] + r[3] + 2 * r[18];
  f[6] = -r[4] - r[5] - r[6] + r[13];
  f[7] = r[4] + r[5] + r[6] + r[7];
  f[8] = -r[7] - r[8];
  f[9] = -r[12] + r[7] + r[9];
  f[10] = -r[9] - r[10] + r[8] + r[11];
  f[11] = r[9];
  f[12] = -r[11] + r[10];
  f[13] = -r[13] + r[12];
  f[14] = r[14];
  f[15] = -r[18] - r[19] + r[16];
  f[16] = -r[20];
  f[17] = r[20];
  f[18] = -r[21] - r[22] - r[24] + r[23] + r[25];
  f[19] = -r[25] + r[24];
};
inline Equation vdpol(Quad eps) {
  return [eps](Quad, const Vector& y, Vector& d) {
    d[0] = y[1];
    d[1] = ((1 - y[0] * y[0]) * y[1] - y[0]) / eps;
  };
}
inline const Equation ringmod = [](Quad t, const Vector& y, Vector& f) {
  static const Quad c = number("1.6e-8"), cs = number("2e-12"), cp = number("1e-8"), r = 25000,
                    rp = 50, lh = number("4.45"), ls1 = number("2e-3"), ls2 = number("5e-4"),
                    g1 = number("36.3"), g2 = number("17.3"), ri = 50, rc = 600,
                    ga = number("40.67286402e-9"), de = number("17.7493332");
  Quad u1 = sinq(2000 * M_PIq * t) / 2, u2 = 2 * sinq(20000 * M_PIq * t);
  auto q = [&](Quad u) { return ga * (expq(de * u) - 1); };
  Quad q1 = q(y[2] - y[4] - y[6] - u2), q2 = q(-y[3] + y[5] - y[6] - u2),
       q3 = q(y[3] + y[4] + y[6] + u2), q4 = q(-y[2] - y[5] + y[6] + u2);
  f[0] = (y[7] - y[9] / 2 + y[10] / 2 + y[13] - y[0] / r) / c;
  f[1] = (y[8] - y[11] / 2 + y[12] / 2 + y[14] - y[1] / r) / c;
  f[2] = (y[9] - q1 + q4) / cs;
  f[3] = (-y[10] + q2 - q3) / cs;
  f[4] = (y[11] + q1 - q3) / cs;
  f[5] = (-y[12] - q2 + q4) / cs;
  f[6] = (-y[6] / rp + q1 + q2 - q3 - q4) / cp;
  f[7] = -y[0] / lh;
  f[8] = -y[1] / lh;
  f[9] = (y[0] / 2 - y[2] - g2 * y[9]) / ls2;
  f[10] = (-y[0] / 2 + y[3] - g2 * y[10]) / ls2;
  f[11] = (y[1] / 2 - y[4] - g2 * y[11]) / ls2;
  f[12] = (-y[1] / 2 + y[5] - g2 * y[12]) / ls2;
  f[13] = (-y[0] + u1 - (ri + g1) * y[13]) / ls1;
  f[14] = (-y[1] - (rc + g1) * y[14]) / ls1;
};
inline const Equation pleiades = [](Quad, const Vector& w, Vector& d) {
  for (int i = 0; i < 14; i++) d[i] = w[14 + i], d[14 + i] = 0;
  for (int i = 0; i < 7; i++)
    for (int j = 0; j < 7; j++)
      if (i != j) {
        Quad x = w[j] - w[i], y = w[7 + j] - w[7 + i], r2 = x * x + y * y,
             m = (j + 1) / (r2 * sqrtq(r2));
        d[14 + i] += m * x;
        d[21 + i] += m * y;
      }
};
inline const Equation lorenz = [](Quad, const Vector& y, Vector& d) {
  d[0] = 10 * (y[1] - y[0]);
  d[1] = y[0] * (28 - y[2]) - y[1];
  d[2] = y[0] * y[1] - Quad(8) / 3 * y[2];
};
inline Equation brusselator(int N) {
  return [N](Quad, const Vector& w, Vector& d) {
    Quad a = Quad(N + 1) * (N + 1) / 50;
    for (int i = 0; i < N; i++) {
      Quad u = w[2 * i], v = w[2 * i + 1], ul = i ? w[2 * i - 2] : Quad(1),
           ur = i < N - 1 ? w[2 * i + 2] : Quad(1), vl = i ? w[2 * i - 1] : Quad(3),
           vr = i < N - 1 ? w[2 * i + 3] : Quad(3);
      d[2 * i] = 1 + u * u * v - 4 * u + a * (ul - 2 * u + ur);
      d[2 * i + 1] = 3 * u - u * u * v + a * (vl - 2 * v + vr);
    }
  };
}
inline Vector brusselator_start(int N) {
  Vector w(2 * N);
  for (int i = 0; i < N; i++) {
    w[2 * i] = 1 + sinq(2 * M_PIq * (i + 1) / (N + 1));
    w[2 * i + 1] = 3;
  }
  return w;
}

inline std::vector<Quad> decades(const std::string& digit, int from, int to) {
  std::vector<Quad> times;
  for (int k = from; k <= to; ++k) times.push_back(number(digit + "e" + std::to_string(k)));
  return times;
}

inline std::map<std::string, Problem> problems() {
  const auto N = [](const char* t) { return number(t); };
  const Guard zero = [](const Vector& y) { return y[0]; };
  return {
      {"robertson",
       {robertson,
        {1, 0, 0},
        decades("4", -1, 10),
        1e-6Q,
        1e-20Q,
        1e-8,
        {[=](const Vector& y) { return y[2] - N("0.01"); },
         [=](const Vector& y) { return y[0] - N("1e-4"); }}}},
      {"hires",
       {hires,
        {1, 0, 0, 0, 0, 0, 0, N("0.0057")},
        {5, 20, 80, 200, 300, N("321.8122")},
        1e-6Q,
        1e-20Q,
        1e-4}},
      {"orego",
       {orego, {1, 2, 3}, {60, 120, 180, 240, 300, 360}, 1e-6Q, 1e-20Q, 1e-2, {[](const Vector& y) {
          return y[0] - 1000;
        }}}},
      {"e5", {e5, {N("1.76e-3"), 0, 0, 0}, decades("1", -4, 13), 1e-9Q, 1e-45Q, 1e-17}},
      {"pollu",
       {pollu,
        {0, N("0.2"), 0, N("0.04"), 0, 0, N("0.1"),   N("0.3"), N("0.01"), 0,
         0, 0,        0, 0,         0, 0, N("0.007"), 0,        0,         0},
        {1, 5, 20, 60},
        1e-10Q,
        1e-24Q,
        1e-10}},
      {"vdpol", {vdpol(N("1e-6")), {2, 0}, {0.5Q, 1, 1.5Q, 2}, 1e-9Q, 1e-10Q, 1e-2, {zero}}},
      {"vdpol-1e6", {vdpol(N("1e-12")), {2, 0}, {0.5Q, 1, 1.5Q, 2}, 1e-14Q, 1e-10Q, 1e-2, {zero}}},
      {"ring-modulator",
       {ringmod,
        Vector(15, 0),
        {N("2.5e-4"), N("5e-4"), N("7.5e-4"), N("1e-3")},
        1e-12Q,
        1e-6Q,
        1e-2}},
      {"brusselator",
       {brusselator(63), brusselator_start(63), {10}, 1e-6Q, 1e-3Q, 1, {[](const Vector& y) {
          return y[62] - 2;
        }}}},
      {"pleiades",
       {pleiades,
        {3, 3, -1, -3, 2, -2,    2,     3, -3, 2, 0,      0, -4, 4,
         0, 0, 0,  0,  0, 1.75Q, -1.5Q, 0, 0,  0, -1.25Q, 1, 0,  0},
        {1, 2, 3},
        1e-4Q,
        1,
        1}},
      {"beam", {beam(40), Vector(80), {N("2.5"), M_PIq, 5}, 1e-4Q, 1e-2Q, 1}},
      {"cusp", {cusp(32), cusp_start(32), {N("1.1")}, 1e-8Q, 1e-2Q, 1}},
      {"plate", {plate, Vector(80), {N("3.5"), 7}, 1e-4Q, 1e-4Q, 1e-3}},
      {"medakzo", {medakzo(200), medakzo_start(200), {5, 20}, 1e-7Q, 1e-4Q, 1}},
      {"emep", {emep(), emep_start(), emep_times(), 1e-6Q, 1e3Q, 1e6}},
      {"lorenz", {lorenz, {0, 1, 0}, {2, 4, 6, 8, 10}, 1e-4Q, 1, 1, {[](const Vector& y) {
                    return y[2] - 27;
                  }}}},
  };
}
