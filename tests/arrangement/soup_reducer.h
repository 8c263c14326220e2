// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <functional>
#include <iosfwd>
#include <optional>
#include <string>

#include "model/triangle_soup.h"

namespace geomend::test {

/// Whether a soup still fails as the one that is to be shrunk does.
using SoupFails = std::function<bool(const TriangleSoup&)>;

/// A soup that fails as the given one does and cannot be made simpler by a single step: no triangle can be left out, no two vertices
/// be one, no coordinate have fewer digits. Triangles go first, by ever smaller shares of them (delta debugging after Zeller and
/// Hildebrandt), then coordinates lose digits, all together, by vertex and one by one. Same soup and verdict, same result.
/// Embedded edges are left out at once where it fails without them, else kept. \pre fails(soup)
TriangleSoup reduced(const TriangleSoup& soup, const SoupFails& fails);

/// A soup as text, `v x y z` and `f patch a b c` with numbers from 0, to the bit; and back. Nothing where a line is none of these.
void write_soup(std::ostream& out, const TriangleSoup& soup);
std::optional<TriangleSoup> read_soup(std::istream& in);

/// A call that makes the soup, to be pasted into a test.
std::string as_code(const TriangleSoup& soup);

}  // namespace geomend::test
