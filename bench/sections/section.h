// A section of the evaluation: it measures one thing and reports it as Markdown for a block of docs/results.md.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace dspm {

struct Setup {
  bool quick = false;                // a reduced run: fewer scenes, frames and iterations
  std::string scene;                 // a scene file instead of the section's own; empty: the section's own
  std::vector<std::string> defines;  // name=value for it
};

struct PlotFile {
  std::string name, svg;  // the text shows it by plot_link(name, ...)
};

struct Findings {
  std::string text;  // Markdown
  std::vector<PlotFile> plots;
};

/// "![sentence](plots/name.svg)"
std::string plot_link(const std::string& name, const std::string& sentence);

struct Section {
  const char* name;  // of its block in the document, too
  const char* sentence;
  Findings (*measure)(const Setup&);
};

/// All sections, in the document's order.
std::span<const Section> sections();
/// Those that can measure any scene, setup.scene.
std::span<const Section> scene_sections();

}  // namespace dspm
