// import dspm: the session and the query of libdspm for Python.
#include "python/module.h"

#include <memory>

#include "dspm/base/params/errors.h"
#include "dspm/base/system/parallel.h"
#include "dspm/base/system/version.h"

namespace {

void set_threads(int threads) {
  if (threads < 0) throw pybind11::value_error("threads: expected a number from 0 on; 0: one for each core");
  static std::unique_ptr<dspm::ThreadLimit> limit;
  limit.reset();  // they end in reverse order
  limit = std::make_unique<dspm::ThreadLimit>(threads);
}

}  // namespace

PYBIND11_MODULE(_dspm, module) {
  namespace py = pybind11;
  using namespace dspm::python;
  module.attr("__version__") = dspm::kVersion;
  py::register_exception<dspm::SceneError>(module, "SceneError", PyExc_ValueError).doc() =
      "The scene cannot be rendered. The text names file, line and column.";
  py::register_exception<dspm::UsageError>(module, "UsageError", PyExc_ValueError).doc() =
      "A choice makes no sense, or does not fit the scene.";
  module.def("set_threads", set_threads, py::arg("threads"),
             "How many threads loops use from now on; 0: one for each core. Results are the same with any number.");
  add_scene(module);
  add_render(module);
  add_rays(module);
  add_surfaces(module);
  add_query(module);
}
