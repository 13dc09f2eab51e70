#pragma once

#include <string_view>

#include "core/streams/stream_info.h"

namespace jnd::core {

/// Whether a stream is one that is looked for. Queries are predicates of XPath over the
/// elements of `stream_xml`; understood are `and`, `or`, `not()`, parentheses, `=` and `!=`
/// between a path of names and a text or number, `starts-with()` and `contains()` of the same.
/// An empty query is for every stream; one that is none of these is for no stream. Not real
/// time.
[[nodiscard]] bool matches_query(const XmlElement& info, std::string_view query);

/// A text in a query, between quotes that it does not hold itself; one that holds both kinds
/// loses its double ones.
[[nodiscard]] std::string quoted_for_query(std::string_view text);

}  // namespace jnd::core
