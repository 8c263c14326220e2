// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/output.h"
#include "model/loss.h"
#include "model/volume_mesh.h"

namespace geomend::meshes {

/// What no file of this family holds: the coordinate system and the pairs of doubled faces.
std::vector<Loss> common_losses(const VolumeMesh& mesh, std::string_view title);

/// A name for a comment: control characters, such as the end of a line, become blanks.
std::string in_a_line(std::string_view name);

bool is_text(const Attribute& a);
/// Writes the values of an attribute of numbers at one thing as they are, each after a blank.
void write_attribute_values(OutputFile& file, const Attribute& a, std::size_t thing);

/// Numbers in lines of so many, each behind what its name begins with.
class NumberRows {
public:
    NumberRows(OutputFile& file, int on_a_line, std::string_view before = {}) : file_(file), most_(on_a_line), before_(before) {}
    ~NumberRows() {
        if (count_ > 0) file_ << '\n';
    }
    NumberRows(const NumberRows&) = delete;
    NumberRows& operator=(const NumberRows&) = delete;
    template <class Number>
    void add(Number number) {
        if (count_ == most_) file_ << '\n', count_ = 0;
        if (count_++ > 0) file_ << ' ';
        file_ << before_;
        file_.number(number);
    }

private:
    OutputFile& file_;
    int most_, count_ = 0;
    std::string_view before_;
};

/// Faces that two cells share, as each of them has it, ascending: only what one cell alone has is the border of a model.
std::vector<CellFaceRef> shared_faces(const CellNetwork& network);

/// Writes the nodes of a cell in the order of the target, counted from 1, each after a separator.
/// \param order per node of the target its number in our order
template <class Order>
void write_nodes(OutputFile& file, std::span<const std::uint32_t> nodes, const Order& order, char separator) {
    for (const std::uint8_t i : order) file << separator, file.number(nodes[i] + 1);
}

/// All types of cells in a mesh that have some first-order type, as blocks.
std::vector<VolumeMeshData::Block> blocks_of(const VolumeMesh& mesh, CellType type);
/// How many cells some blocks have.
std::uint64_t cells_in(std::span<const VolumeMeshData::Block> blocks);

}  // namespace geomend::meshes
