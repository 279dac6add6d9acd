// Sources of signals: chirps, tables of data, random numbers.
#include "blocks.hpp"
#include "saltus/library/chirp.hpp"
#include "saltus/library/data_source.hpp"
#include "saltus/library/random_number.hpp"
#include "saltus/library/sawtooth.hpp"
#include "saltus/library/white_noise.hpp"

namespace saltus::python {

void bind_signals(py::module_& module) {
  using Handle = const py::object&;
  py::class_<Chirp, System>(module, "Chirp")
      .def(py::init([](const std::string& name, Handle f0, Handle f1, double stop_time,
                       Handle phi) {
        const Arguments of(name);
        return std::make_unique<Chirp>(name, ChirpOptions{of.value(f0, "f0"), of.value(f1, "f1"),
                                                          stop_time, of.value(phi, "phi")});
      }));
  py::class_<DataSource, System>(module, "DataSource")
      .def(py::init([](const std::string& name, Handle times, Handle values,
                       std::string_view interpolation, std::string_view extrapolation) {
        const Arguments of(name);
        return std::make_unique<DataSource>(name, of.vector(times, "times"),
                                            of.columns(values, "values"),
                                            DataSourceOptions{interpolation, extrapolation});
      }));
  py::class_<RandomNumber, System>(module, "RandomNumber")
      .def(py::init([](const std::string& name, double dt, std::string_view distribution,
                       double seed, Handle mean, Handle standard_deviation, Handle lower_limit,
                       Handle upper_limit) {
        const Arguments of(name);
        return std::make_unique<RandomNumber>(
            name, dt,
            RandomNumberOptions{
                .distribution = distribution,
                .seed = seed,
                .mean = of.value(mean, "mean"),
                .standard_deviation = of.value(standard_deviation, "standard_deviation"),
                .lower_limit = of.value(lower_limit, "lower_limit"),
                .upper_limit = of.value(upper_limit, "upper_limit")});
      }));
  py::class_<Sawtooth, System>(module, "Sawtooth")
      .def(py::init([](const std::string& name, Handle amplitude, double frequency,
                       double phase_delay) {
        return std::make_unique<Sawtooth>(
            name,
            SawtoothOptions{Arguments(name).value(amplitude, "amplitude"), frequency, phase_delay});
      }));
  py::class_<WhiteNoise, System>(module, "WhiteNoise")
      .def(py::init([](const std::string& name, double dt, Handle power, double seed) {
        return std::make_unique<WhiteNoise>(
            name, dt, WhiteNoiseOptions{Arguments(name).value(power, "power"), seed});
      }));
}

}  // namespace saltus::python
