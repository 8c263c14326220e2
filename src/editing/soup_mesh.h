// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/origin.h"
#include "model/triangle_soup.h"

namespace geomend::editing {

/// A soup with its origin in another one.
struct EditedSoup {
    TriangleSoup soup;
    Origin origin;
};

/// A soup while triangles are taken out of it and put into it. Vertices keep their numbers until the end.
class SoupMesh {
public:
    /// Cost: linear. \pre check(soup)
    explicit SoupMesh(TriangleSoup soup);

    const TriangleSoup& soup() const { return soup_; }
    const Vec3& place(std::uint32_t v) const { return soup_.vertices[v]; }
    const Triangle& triangle(std::uint32_t t) const { return soup_.triangles[t]; }
    std::uint32_t patch(std::uint32_t t) const { return soup_.patches[t]; }
    /// The triangle of the soup as it was that a triangle is a piece of.
    std::uint32_t from(std::uint32_t t) const { return from_[t]; }
    /// The triangles at a vertex, in no special order.
    std::span<const std::uint32_t> around(std::uint32_t v) const { return around_[v]; }
    bool has_edge(std::uint32_t a, std::uint32_t b) const;
    /// Whether an embedded edge ends at a vertex.
    bool is_marked(std::uint32_t v) const { return marked_[v] != 0; }

    /// \param from a triangle of the soup as it was \return the number of the new triangle
    std::uint32_t add(const Triangle& triangle, std::uint32_t patch, std::uint32_t from);
    void drop(std::uint32_t t);
    /// \param origin in the soup as it was \return the number of the new vertex
    std::uint32_t add_vertex(const Vec3& place, const Origin::Vertex& origin);
    void set_patch(std::uint32_t t, std::uint32_t patch) { soup_.patches[t] = patch; }
    void move(std::uint32_t v, const Vec3& to) { soup_.vertices[v] = to; }

    /// The soup as it is now: triangles in the order of those that they come from, without vertices that none uses any more.
    /// Vertices keep their origin. Cost: n log n.
    EditedSoup take() &&;

private:
    TriangleSoup soup_;
    std::vector<std::uint32_t> from_;
    std::vector<Origin::Vertex> made_;  ///< of vertices that were added
    std::size_t first_made_;
    std::vector<std::uint8_t> live_, marked_;
    std::vector<std::vector<std::uint32_t>> around_;
};

}  // namespace geomend::editing
