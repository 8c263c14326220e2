// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "model/brep.h"
#include "remesh/pattern.h"

namespace geomend::remeshing {

/// The lines of a model with the places that take the place of their vertices. A new vertex has a name: the number of the model's vertex
/// where it stays at that one, else a number above all of these that no other vertex has had.
class LinePlan {
public:
    /// \param lines how many of the lines are the model's own; the others are creases
    LinePlan(const BrepData& brep, std::size_t lines);

    std::size_t size() const { return lines_.size(); }

    struct Use {
        std::uint32_t line, segment;
        bool forward;  ///< the line runs as the edge that was asked for
    };
    /// The piece of a line between two vertices of the model.
    std::optional<Use> find(std::uint32_t from, std::uint32_t to) const;

    struct Named {
        LineSample sample;
        std::uint32_t name;
    };
    std::span<const Named> samples(std::uint32_t line) const { return lines_[line].samples; }
    /// Those inside of a segment, ascending.
    std::span<const Named> inside(std::uint32_t line, std::uint32_t segment) const;
    const Vec3& place(std::uint32_t name) const {
        return name < brep_.vertices.size() ? brep_.vertices[name] : made_[name - brep_.vertices.size()];
    }

    /// Whether a vertex of the model stays: it is a sample of its line, a corner, or one that several surfaces have without a line.
    bool stays(std::uint32_t vertex) const { return stays_[vertex] != 0; }
    /// Whether it lies on a line and is no corner.
    bool on_line(std::uint32_t vertex) const { return line_of_[vertex] != no_index; }

    /// Keeps a vertex of a line from now on. \return whether it was not kept before
    bool force(std::uint32_t vertex);
    /// Keeps all vertices of a line from now on. \return as of force()
    bool keep(std::uint32_t line);
    bool kept(std::uint32_t line) const { return lines_[line].kept; }

    /// Samples a line anew. \param sizes of the model's vertices \param pattern takes the place of them where it is given
    /// \return whether anything changed
    bool sample(std::uint32_t line, const VertexSizes& sizes, double max_distance, const Pattern* pattern = nullptr);
    /// Lowers the sizes at the vertices of a line to those of its new edges.
    void limit(std::uint32_t line, double least, std::span<double> sizes) const;

private:
    struct Plan {
        std::vector<Vec3> points;
        std::vector<std::uint8_t> forced;
        std::uint32_t fewest = 1;
        bool kept = false;
        std::vector<Named> samples;
    };
    struct Edge {
        std::uint32_t low, high, line, segment;
    };
    void keep_joined_edges(std::size_t lines);

    const BrepData& brep_;
    std::vector<Plan> lines_;
    std::vector<Edge> edges_;  // ascending
    std::vector<std::uint32_t> line_of_, index_of_;
    std::vector<std::uint8_t> stays_;
    std::vector<Vec3> made_;
};

}  // namespace geomend::remeshing
