// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/meshes/write_tough2.h"

#include <array>
#include <cmath>
#include <cstdio>

#include "base/vectors.h"
#include "formats/meshes/mesh_writing.h"

namespace geomend::meshes {

namespace {

constexpr std::uint64_t most_cells = 26ull * 36 * 36 * 100;

/// Five characters: a letter, two figures or letters, two figures.
std::string element_name(std::uint64_t cell) {
    constexpr std::string_view signs = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ";
    const std::uint64_t head = cell / 100, tail = cell % 100;
    return {signs[10 + head / (36 * 36)], signs[head / 36 % 36], signs[head % 36], signs[tail / 10], signs[tail % 10]};
}

/// Ten characters of a number, with an exponent: the program reads by columns. Positive ones have a digit more.
std::string in_ten(double value) {
    std::array<char, 40> text{};
    const int size =
        value < 0 ? std::snprintf(text.data(), text.size(), "%10.3E", value) : std::snprintf(text.data(), text.size(), "%10.4E", value);
    return {text.data(), static_cast<std::size_t>(size)};
}

std::string cosine_in_ten(double value) {
    std::array<char, 40> text{};
    const int size = std::snprintf(text.data(), text.size(), "%10.7f", value);
    return {text.data(), static_cast<std::size_t>(size)};
}

std::string five(std::string_view word) {
    std::string text(word.substr(0, 5));
    text.resize(5, ' ');
    return text;
}

double distance(const Vec3& a, const Vec3& b) {
    const Vec3 d = minus(b, a);
    return std::sqrt(dot(d, d));
}

/// How far along the line between two centres its face lies, kept within it.
double share_to_face(const Vec3& from, const Vec3& to, const CellNetwork::Connection& c) {
    const double way = dot(minus(to, from), c.area), part = dot(minus(c.centre, from), c.area);
    return way > 0 ? std::min(std::max(part / way, 1e-6), 1 - 1e-6) : 0.5;
}

}  // namespace

Result<std::vector<Loss>> write_tough2(const VolumeMesh& mesh, OutputSet& out, const WriteOptions&) {
    if (mesh->cell_count() > most_cells)
        return failure(FailureKind::cannot_hold, "F021", {out.main_path().string()},
                       std::to_string(mesh->cell_count()) + " cells: names of five characters are enough for " +
                           std::to_string(most_cells) + "; choose a larger --size");
    std::vector<Loss> losses = common_losses(mesh, "TOUGH2");
    add_loss(losses, {LossClass::identity, mesh->name, "digits of volumes, areas and positions", "TOUGH2 reads ten characters of a number",
                      mesh->cell_count()});
    const CellNetwork& network = mesh->network;
    OutputFile& file = out.main_file();
    file << "ELEME\n";
    for (const VolumeMeshData::Block& block : mesh->blocks) {
        for (std::uint32_t c = block.first; c < block.first + block.count && file.good(); ++c) {
            const Vec3& p = network.centres[c];
            file << element_name(c) << std::string(10, ' ') << five(mesh->regions[block.region]) << in_ten(network.volumes[c])
                 << std::string(20, ' ');
            for (const double x : p) file << in_ten(x);
            file << '\n';
        }
    }
    file << "\nCONNE\n";
    for (const auto& c : network.connections) {
        const Vec3 &from = network.centres[c.from], &to = network.centres[c.to];
        const double way = distance(from, to), share = share_to_face(from, to, c), down = way > 0 ? (from[2] - to[2]) / way : 0;
        const char* isot = std::abs(down) > std::sqrt(0.5) ? "    3" : "    1";
        file << element_name(c.from) << element_name(c.to) << std::string(15, ' ') << isot << in_ten(share * way)
             << in_ten((1 - share) * way) << in_ten(std::sqrt(dot(c.area, c.area))) << cosine_in_ten(down) << '\n';
    }
    file << "\n";
    return losses;
}

}  // namespace geomend::meshes
