// What the module is made of: each adds its classes.
#pragma once

#include <pybind11/pybind11.h>

namespace dspm::python {

void add_scene(pybind11::module_& module);
void add_render(pybind11::module_& module);
void add_rays(pybind11::module_& module);
void add_query(pybind11::module_& module);
void add_surfaces(pybind11::module_& module);

}  // namespace dspm::python
