// Lists where photon paths started and how many were found, light by light: a part of the report of a run.
#pragma once

#include <string>

#include "dspm/base/system/json.h"
#include "dspm/integrators/emission_report.h"

namespace dspm {

/// Returns an empty text if there are no reports.
std::string table_of(const EmissionReports& reports);
/// Writes an array.
void write(JsonWriter& json, const EmissionReports& reports);

}  // namespace dspm
