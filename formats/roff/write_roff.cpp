// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/roff/write_roff.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/number_text.h"
#include "formats/roff/losses.h"
#include "formats/roff/node_depths.h"
#include "formats/roff/read_roff.h"
#include "formats/roff/subgrids.h"
#include "formats/roff/tag_text.h"
#include "formats/roff/write_parameters.h"
#include "model/annotations.h"

namespace geomend::roff {

namespace {

/// real = (local + offset) * scale
struct Frame {
    Vec3 offset{0, 0, 0}, scale{1, 1, -1};
    bool stated = false;
};

/// Three numbers that are floats, as the file stores them.
bool take_three(const std::string* text, Vec3& to) {
    if (text == nullptr) return false;
    Vec3 read{};
    const char *p = text->data(), *end = p + text->size();
    for (double& v : read) {
        while (p != end && *p == ' ') ++p;
        const auto [stop, error] = std::from_chars(p, end, v);
        if (error != std::errc{} || !std::isfinite(v) || static_cast<double>(static_cast<float>(v)) != v) return false;
        p = stop;
    }
    to = read;
    return p == end;
}

/// Large coordinates keep more digits around an offset; a multiple of 256 is exact as a float.
double offset_for(double low, double high) {
    const double middle = low + (high - low) / 2, extent = high - low;
    if (!(std::abs(middle) > 4 * extent) || std::abs(middle) < 4096 || std::abs(middle) > 4e9) return 0;
    return std::round(middle / 256) * 256;
}

Frame frame_of(const CornerPointGrid& grid) {
    Frame frame;
    const bool has_offset = take_three(find_annotation(grid.info, translate_key), frame.offset);
    const bool has_scale =
        take_three(find_annotation(grid.info, scale_key), frame.scale) && frame.scale[0] != 0 && frame.scale[1] != 0 && frame.scale[2] != 0;
    if (!has_scale) frame.scale = {1, 1, grid.info.crs.z_positive == ZPositive::elevation ? 1.0 : -1.0};
    if (has_offset && has_scale) return frame;
    frame.offset = {0, 0, 0};
    for (std::size_t d = 0; d < 2; ++d) {
        double low = INFINITY, high = -INFINITY;
        for (std::size_t v = d; v < grid.pillars.size(); v += 3) {
            low = std::min(low, grid.pillars[v]);
            high = std::max(high, grid.pillars[v]);
        }
        if (low <= high) frame.offset[d] = offset_for(low, high);
    }
    return frame;
}

class RoffWriter {
public:
    RoffWriter(const CornerPointGrid& grid, OutputFile& file, bool text, const WriteOptions& options, std::vector<Loss>& losses)
        : grid_(grid), to_(Sink(file), text), file_(file), options_(options), losses_(losses) {}

    Result<void> run() {
        to_.start();
        to_.comment("Creator: geomend");
        write_file_data();
        to_.begin_tag("version");
        to_.value("major", 2);
        to_.value("minor", 0);
        to_.end_tag();
        to_.begin_tag("dimensions");
        const char* names[] = {"nX", "nY", "nZ"};
        for (std::size_t d = 0; d < 3; ++d) to_.value(names[d], static_cast<std::int32_t>(grid_.dims[d]));
        to_.end_tag();
        if (!grid_.depths.empty()) {
            if (auto done = write_geometry(); !done) return done;
        }
        write_activity();
        write_kept();
        write_parameters(to_, grid_, losses_);
        to_.begin_tag("eof");
        to_.end_tag();
        return {};
    }

private:
    bool stopped() const { return options_.monitor != nullptr && options_.monitor->stopped(); }

    void write_file_data() {
        to_.begin_tag("filedata");
        to_.value("byteswaptest", 1);
        to_.value("filetype", std::string_view(grid_.depths.empty() ? "parameter" : "grid"));
        std::string date = "UNKNOWN";
        for (const Annotation& a : grid_.info.annotations) {
            if (a.key != tag_key) continue;
            const auto kept = tag_from_text(a.value);
            if (!kept || kept->tags.front().name != "filedata") continue;
            const Entry* entry = find_entry(kept->tags.front(), "creationDate");
            const auto words = entry != nullptr ? texts(*kept, *entry) : Result<std::vector<std::string>>(std::vector<std::string>{});
            if (words && words->size() == 1) date = words->front();
        }
        to_.value("creationDate", std::string_view(date));
        to_.end_tag();
    }

    double sign() const { return grid_.info.crs.z_positive == ZPositive::elevation ? -1.0 : 1.0; }

    /// The value as the file stores it; keeps account of rounding.
    float local(std::size_t axis, double real) {
        const double turned = axis == 2 ? sign() * real : real;
        const double exact = turned / frame_.scale[axis] - frame_.offset[axis] + 0.0;
        const auto stored = static_cast<float>(exact);
        const double back = (static_cast<double>(stored) + frame_.offset[axis]) * frame_.scale[axis];
        if (back != turned) {
            ++rounded_;
            largest_ = std::max(largest_, std::abs(back - turned));
        }
        return stored;
    }

    Result<void> write_geometry() {
        frame_ = frame_of(grid_);
        to_.begin_tag("translate");
        const char* offsets[] = {"xoffset", "yoffset", "zoffset"};
        for (std::size_t d = 0; d < 3; ++d) to_.value(offsets[d], static_cast<float>(frame_.offset[d]));
        to_.end_tag();
        to_.begin_tag("scale");
        const char* scales[] = {"xscale", "yscale", "zscale"};
        for (std::size_t d = 0; d < 3; ++d) to_.value(scales[d], static_cast<float>(frame_.scale[d]));
        to_.end_tag();
        write_subgrids();
        write_lines();
        if (stopped()) return failure(FailureKind::cancelled, "F022", {grid_.info.name}, "stopped");
        write_depths();
        if (stopped()) return failure(FailureKind::cancelled, "F022", {grid_.info.name}, "stopped");
        if (!std::isfinite(largest_))
            return failure(FailureKind::cannot_hold, "F021", {grid_.info.name},
                           "coordinates are beyond single precision, which ROFF stores");
        add_rounding_loss(grid_, rounded_, largest_, losses_);
        return {};
    }

    void write_lines() {
        to_.begin_tag("cornerLines");
        to_.begin_floats("data", grid_.pillars.size());
        const std::size_t lines_x = std::size_t{grid_.dims[0]} + 1, lines_y = std::size_t{grid_.dims[1]} + 1;
        float line[6];
        for (std::size_t i = 0; i < lines_x; ++i) {
            for (std::size_t j = 0; j < lines_y; ++j) {
                const double* pillar = grid_.pillars.data() + 6 * (i + lines_x * j);
                for (std::size_t v = 0; v < 6; ++v) line[(v + 3) % 6] = local(v % 3, pillar[v]);  // the bottom first
                to_.more_floats(line);
            }
        }
        to_.end_floats();
        to_.end_tag();
    }

    void write_depths() {
        to_.begin_tag("zvalues");
        const std::vector<std::uint8_t> splits = node_splits(grid_);
        to_.array("splitEnz", splits, false);
        std::uint64_t count = 0;
        for (const std::uint8_t s : splits) count += s;
        to_.begin_floats("data", count);
        std::vector<float> values;
        for (std::size_t i = 0; i <= grid_.dims[0] && file_.good() && !stopped(); ++i) {
            values.clear();
            for_each_node_depth(grid_, splits, i, [&](double z) { values.push_back(local(2, z)); });
            to_.more_floats(values);
        }
        to_.end_floats();
        to_.end_tag();
    }

    void write_activity() {
        if (grid_.activity.empty()) return;
        const auto [nx, ny, nz] = grid_.dims;
        std::vector<std::uint8_t> values;
        values.reserve(grid_.cell_count());
        for (std::uint32_t i = 0; i < nx; ++i) {
            for (std::uint32_t j = 0; j < ny; ++j) {
                for (std::uint32_t k = nz; k-- > 0;) values.push_back(grid_.activity[grid_.cell(i, j, k)] != 0 ? 1 : 0);
            }
        }
        to_.begin_tag("active");
        to_.array("data", values, true);
        to_.end_tag();
    }

    /// Only where their layers are still those of the grid.
    void write_subgrids() {
        for (const Annotation& a : grid_.info.annotations) {
            if (a.key != tag_key) continue;
            const auto kept = tag_from_text(a.value);
            if (!kept || kept->tags.front().name != "subgrids") continue;
            if (!subgrid_layers(grid_).empty()) {
                write_tag(*kept);
            } else {
                add_loss(losses_, {LossClass::identity, grid_.info.name, "subgrids", "their layers do not add up to those of the grid"});
            }
        }
    }

    void write_kept() {
        for (const Annotation& a : grid_.info.annotations) {
            if (a.key != tag_key) continue;
            const auto kept = tag_from_text(a.value);
            if (!kept) {
                add_loss(losses_, {LossClass::identity, grid_.info.name, "a kept tag", "its text is damaged"});
                continue;
            }
            const std::string& name = kept->tags.front().name;
            if (name != "filedata" && name != "subgrids") write_tag(*kept);
        }
    }

    void write_tag(const Document& kept) {
        to_.begin_tag(kept.tags.front().name);
        for (const Entry& entry : kept.tags.front().entries) write_entry(to_, kept, entry);
        to_.end_tag();
    }

    const CornerPointGrid& grid_;
    TokenWriter to_;
    OutputFile& file_;
    const WriteOptions& options_;
    std::vector<Loss>& losses_;
    Frame frame_;
    std::uint64_t rounded_ = 0;
    double largest_ = 0;
};

Result<std::vector<Loss>> write(const Dataset& dataset, OutputSet& out, const WriteOptions& options, bool text) {
    std::vector<Loss> losses;
    const auto grid = choose_grid(dataset, out, losses);
    if (!grid) return grid.why();
    add_grid_losses(**grid, out, losses);
    if (auto done = RoffWriter(**grid, out.main_file(), text, options, losses).run(); !done) return done.why();
    return losses;
}

}  // namespace

Result<std::vector<Loss>> write_roff_binary(const Dataset& dataset, OutputSet& out, const WriteOptions& options) {
    return write(dataset, out, options, false);
}
Result<std::vector<Loss>> write_roff_text(const Dataset& dataset, OutputSet& out, const WriteOptions& options) {
    return write(dataset, out, options, true);
}

}  // namespace geomend::roff
