#pragma once

#include <string_view>

#include "core/streams/stream_info.h"

namespace jnd::core {

/// Whether a stream fits a query. Queries are predicates of XPath over the elements of
/// `stream_xml`. It understands `and`, `or`, `not()`, parentheses, `=` and `!=` between a path
/// of names and a text or number, and `starts-with()` and `contains()` of the same. An empty
/// query fits every stream, and a query that it does not understand fits none. Not real time.
[[nodiscard]] bool matches_query(const XmlElement& info, std::string_view query);

/// Returns the text in quotes for a query. It uses the kind of quotes that the text lacks. If
/// the text has both kinds, its double ones are left out.
[[nodiscard]] std::string quoted_for_query(std::string_view text);

}  // namespace jnd::core
