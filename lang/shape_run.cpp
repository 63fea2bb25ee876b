#include "dspm/lang/shape_run.h"

#include <algorithm>
#include <utility>
#include <variant>

#include "dspm/base/params/params.h"

namespace dspm {
namespace {

constexpr std::size_t kMostNumbers = std::size_t{1} << 31;  // then another run begins

/// Returns the numbers per value; 0 if the values are not plain numbers.
std::size_t dimension_of(ParamType type) {
  switch (type) {
    case ParamType::number: return 1;
    case ParamType::point2:
    case ParamType::vector2: return 2;
    case ParamType::point3:
    case ParamType::vector3:
    case ParamType::normal: return 3;
    default: return 0;
  }
}

bool are_equal(const SourceLocation& a, const SourceLocation& b) {
  return a.file == b.file && a.line == b.line && a.column == b.column;
}

const char* end_of(std::string_view text) { return text.data() + text.size(); }

}  // namespace

std::optional<ShapeRun> ShapeRun::after(const ShapeUse& first, std::shared_ptr<const SourceText> source,
                                        std::string_view words) {
  ShapeRun run(std::move(source));
  return run.take_pieces(first, words) ? std::optional(std::move(run)) : std::nullopt;
}

/// Returns false unless all parameters are found in the text: a translation from pbrt-v3 may have made others.
bool ShapeRun::take_pieces(const ShapeUse& first, std::string_view words) {
  const std::vector<Param>& params = first.params.params;
  declared_.resize(params.size());
  std::size_t strings = 0, found = 0;
  std::vector<float> numbers;
  Lexer lexer(*source_);
  lexer.go_on_at(words.data());
  const char *piece = words.data(), *end = piece;
  while (lexer.rest().data() != end_of(words)) {
    const Token token = lexer.next();
    end = end_of(token.text);
    if (token.kind != Token::Kind::string) continue;
    const std::size_t which = strings++;
    const auto param = std::find_if(params.begin(), params.end(),
                                    [&](const Param& p) { return are_equal(p.where, lexer.locate(token.text)); });
    if (param == params.end()) continue;
    const auto number = static_cast<std::size_t>(param - params.begin());
    declared_[number] = which, ++found;
    const std::size_t dimension = dimension_of(param->type);
    if (dimension == 0) continue;
    const bool is_bare = lexer.peek().kind != Token::Kind::open;
    if (!is_bare) end = end_of(lexer.next().text);
    pieces_.push_back({view(piece, end), number, dimension, is_bare});
    numbers.clear();
    if (!lexer.plain_numbers(numbers) || numbers != std::get<std::vector<float>>(param->values)) return false;
    piece = end = lexer.rest().data();
  }
  tail_ = view(piece, end);
  return !pieces_.empty() && found == params.size();
}

const char* ShapeRun::read(const char* at) {
  Lexer lexer(*source_);
  lexer.go_on_at(at);
  const char* begin = lexer.rest().data();
  while (numbers_.size() < kMostNumbers && read_one(lexer)) {
    places_.push_back(static_cast<std::size_t>(begin - source_->text().data()));
    begin = lexer.rest().data();
  }
  forget_after(count());
  return begin;
}

/// Reads one directive. If another parameter follows, or something that has no place there, it is no repetition.
bool ShapeRun::read_one(Lexer& lexer) {
  for (const Piece& piece : pieces_) {
    const std::size_t before = numbers_.size();
    if (!lexer.skip(piece.text) || !lexer.plain_numbers(numbers_)) return false;
    const std::size_t count = numbers_.size() - before;
    if (piece.is_bare ? count != 1 : count % piece.dimension != 0) return false;
    ends_.push_back(static_cast<std::uint32_t>(numbers_.size()));
  }
  const char* const end = lexer.rest().data() + tail_.size();
  if (!lexer.skip(tail_)) return false;
  const std::string_view next = lexer.rest();
  const bool is_apart = tail_.empty() || next.data() != end;
  return next.empty() || (is_apart && next.front() >= 'A' && next.front() <= 'Z');
}

/// Forgets what was read of a directive that is no repetition.
void ShapeRun::forget_after(std::size_t directives) {
  ends_.resize(directives * pieces_.size());
  numbers_.resize(ends_.empty() ? 0 : ends_.back());
}

void ShapeRun::set_numbers(std::size_t i, ParamList& params) const {
  for (std::size_t k = 0; k < pieces_.size(); ++k) {
    const std::size_t list = i * pieces_.size() + k;
    const auto begin = numbers_.begin() + (list == 0 ? 0 : static_cast<std::ptrdiff_t>(ends_[list - 1]));
    std::get<std::vector<float>>(params.params[pieces_[k].param].values)
        .assign(begin, numbers_.begin() + static_cast<std::ptrdiff_t>(ends_[list]));
  }
}

ShapeUse ShapeRun::at(std::size_t i, const ShapeUse& first) const {
  ShapeUse use = first;
  use.run = nullptr;
  set_numbers(i, use.params);
  Lexer lexer(*source_);
  lexer.go_on_at(source_->text().data() + places_[i]);
  use.where = lexer.locate(lexer.next().text);
  use.type_where = lexer.locate(lexer.peek().text);
  const std::size_t last = declared_.empty() ? 0 : *std::max_element(declared_.begin(), declared_.end());
  for (std::size_t string = 0; string <= last;) {
    const Token token = lexer.next();
    if (token.kind != Token::Kind::string) continue;
    const auto declared = std::find(declared_.begin(), declared_.end(), string++);
    if (declared == declared_.end()) continue;
    Param& param = use.params.params[static_cast<std::size_t>(declared - declared_.begin())];
    param.where = lexer.locate(token.text);
    if (lexer.peek().kind == Token::Kind::open) lexer.next();
    param.values_where = lexer.locate(lexer.peek().text);
  }
  return use;
}

std::size_t count_directives(const std::vector<ShapeUse>& shapes) {
  std::size_t count = shapes.size();
  for (const ShapeUse& use : shapes) count += use.run != nullptr ? use.run->count() : 0;
  return count;
}

}  // namespace dspm
