#include "dspm/output/report/image_index.h"

#include <algorithm>

#include "dspm/base/system/extension.h"
#include "dspm/base/system/json.h"
#include "dspm/session/job/named_parts.h"

namespace dspm {
namespace {

namespace fs = std::filesystem;

std::string seen_from(const fs::path& file, const fs::path& image) {
  std::error_code ignored;
  const fs::path relative = fs::absolute(image, ignored)
                                .lexically_normal()
                                .lexically_relative(fs::absolute(file, ignored).lexically_normal().parent_path());
  return relative.empty() ? image.string() : relative.string();
}

/// Quotes a field if it holds a comma, a quote or the end of a line. [RFC 4180]
std::string quoted(const std::string& field) {
  if (field.find_first_of(",\"\r\n") == field.npos) return field;
  std::string text(1, '"');
  for (const char c : field) text.append(c == '"' ? 2 : 1, c);
  return text + '"';
}

std::string line_of(const std::vector<std::string>& fields) {
  std::string line;
  for (const std::string& field : fields) {
    if (&field != &fields.front()) line += ',';
    line += quoted(field);
  }
  line += "\r\n";
  return line;
}

/// Returns the fields that there are of "file", "png", "denoised", "variation", each axis, "frame".
std::vector<NamedPart> fields_of(const fs::path& file, const Job& job, const IndexedImage& image) {
  std::vector<NamedPart> fields{{"file", seen_from(file, image.files.front())}};
  if (image.files.size() > 1) fields.push_back({"png", seen_from(file, image.files.back())});
  if (!image.denoised.empty()) fields.push_back({"denoised", seen_from(file, image.denoised)});
  for (NamedPart& part : parts_of(job, image.frame)) fields.push_back(std::move(part));
  if (job.numbered) fields.push_back({"frame", std::to_string(job.moment(image.frame).number())});
  return fields;
}

std::string as_csv(const fs::path& file, const Job& job, const std::vector<IndexedImage>& images) {
  std::string text;
  for (const IndexedImage& image : images) {
    std::vector<std::string> names, texts;
    for (const NamedPart& field : fields_of(file, job, image)) names.push_back(field.name), texts.push_back(field.text);
    if (text.empty()) text = line_of(names);
    text += line_of(texts);
  }
  return text;
}

/// The axes are an object of their own, as they may be called anything.
std::string as_json(const fs::path& file, const Job& job, const std::vector<IndexedImage>& images) {
  JsonWriter json;
  json.begin_array();
  for (const IndexedImage& image : images) {
    json.begin_object();
    json.member("file", seen_from(file, image.files.front()));
    if (image.files.size() > 1) json.member("png", seen_from(file, image.files.back()));
    if (!image.denoised.empty()) json.member("denoised", seen_from(file, image.denoised));
    const std::vector<NamedPart> parts = parts_of(job, image.frame);
    if (!parts.empty()) {
      json.member("variation", parts.front().text);
      json.key("axes");
      json.begin_object();
      for (std::size_t i = 1; i < parts.size(); ++i) json.member(parts[i].name, parts[i].text);
      json.end_object();
    }
    if (job.numbered) json.member("frame", job.moment(image.frame).number());
    json.end_object();
  }
  json.end_array();
  return json.text();
}

}  // namespace

std::string image_index(const fs::path& file, const Job& job, const std::vector<IndexedImage>& images) {
  return extension_of(file) == ".json" ? as_json(file, job, images) : as_csv(file, job, images);
}

}  // namespace dspm
