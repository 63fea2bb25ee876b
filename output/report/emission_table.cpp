#include "dspm/output/report/emission_table.h"

#include <fmt/format.h>

#include "dspm/base/system/readable.h"

namespace dspm {
namespace {

double found_share(const EmissionReport::OfLight& light) {
  return light.started > 0 ? static_cast<double>(light.found) / static_cast<double>(light.started) : 0;
}

const char* word_of(EmissionReport::Start start) {
  switch (start) {
    case EmissionReport::Start::guided: return "guided";
    case EmissionReport::Start::guide_would_not_pay: return "power, as no guide pays";
    case EmissionReport::Start::needs_none: return "no photons are traced";
    case EmissionReport::Start::asked_by_power: break;
  }
  return "power";
}

const char* word_of(PhotonsBring bring) {
  switch (bring) {
    case PhotonsBring::all: break;
    case PhotonsBring::caustics: return "caustics";
    case PhotonsBring::nothing: return "nothing";
  }
  return "all";
}

void write(JsonWriter& json, const EmissionReport& report) {
  json.begin_object();
  json.member("photons", report.photons);
  json.member("emission", word_of(report.start));
  json.member("bring", word_of(report.bring));
  if (report.traced > 0) json.member("traced_an_iteration", report.traced);
  json.member("pilot_rounds", report.rounds);
  json.member("paths_a_pilot_round", report.paths);
  json.member("found_without_guide", report.found_without);
  json.member("found", report.found);
  json.member("guide_cells", report.cells);
  json.key("lights").begin_array();
  for (const EmissionReport::OfLight& light : report.lights) {
    json.begin_object();
    json.member("name", light.name);
    json.member("share_by_power", light.by_power);
    json.member("share", light.share);
    json.member("pilot_paths", light.started);
    json.member("found", light.found);
    json.end_object();
  }
  json.end_array();
  json.end_object();
}

}  // namespace

std::string table_of(const EmissionReports& reports) {
  std::string text;
  for (const EmissionReport& report : reports) {
    if (report.bring != PhotonsBring::all || report.traced > 0) text += fmt::format("\n  {}\n", summary_of(report));
    if (report.bring == PhotonsBring::nothing) continue;
    text += fmt::format("\n  {:<24}{:>16}{:>18}{:>10}\n", report.photons + " of", "paths by power", "paths", "found");
    for (const EmissionReport::OfLight& light : report.lights)
      text += fmt::format("  {:<24}{:>15.1f}%{:>17.1f}%{:>9.1f}%\n", light.name, 100 * light.by_power,
                          100 * light.share, 100 * found_share(light));
    text += fmt::format("  found: {} of {} pilot paths, {} without a guide; {} guide cells after {} of them\n",
                        grouped(report.found), grouped(report.paths), grouped(report.found_without),
                        grouped(report.cells), counted(report.rounds, "round"));
  }
  return text;
}

void write(JsonWriter& json, const EmissionReports& reports) {
  json.begin_array();
  for (const EmissionReport& report : reports) write(json, report);
  json.end_array();
}

}  // namespace dspm
