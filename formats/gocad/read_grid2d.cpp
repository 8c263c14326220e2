// SPDX-License-Identifier: AGPL-3.0-or-later
#include <cmath>
#include <string>
#include <utility>

#include "formats/gocad/array_object.h"
#include "formats/gocad/array_properties.h"
#include "formats/gocad/object_readers.h"

// GSurf and its like: a lattice in U and V whose first property is the height along W. It becomes a raster with the
// elevation as its height attribute. With TYPE CELLS the values stand at the centres of the (nu-1)(nv-1) cells.

namespace geomend::gocad {

namespace {

class Grid2dReader {
public:
    explicit Grid2dReader(ObjectScanner& scanner) : scanner_(scanner), log_(scanner.log), object_(scanner) {}

    Result<void> run() {
        axes_.axis[2] = {0, 0, 1};
        auto whole = object_.read_records([this](std::string_view keyword, TextCursor& line) { return take(keyword, line); });
        if (!whole) return whole;
        if (!axes_.complete(2, scanner_.frame.line, log_) || !check_shape()) return {};
        Raster raster;
        axes_.place(raster, false);
        raster.dims[2] = 1;
        if (cells_) move_to_centres(raster);
        ArrayPlace place;
        place.dims = raster.dims;
        for (IndexedProperty& p : properties_.properties) p.alignment = "POINTS";
        head_.info.attributes = read_array_properties(std::move(properties_.properties), place, files_, scanner_, nullptr);
        if (scanner_.stopped()) return scanner_.stop();
        if (log_.has_error()) return {};
        files_.report_rest();
        raster.info = std::move(head_.info);
        if (!raster.info.attributes.empty()) heights_to_elevation(raster);
        else if (raster.info.crs.z_positive == ZPositive::depth) {
            raster.origin[2] = -raster.origin[2];
            for (Vec3& s : raster.step) s[2] = -s[2];
        }
        scanner_.objects.emplace_back(std::move(raster));
        return {};
    }

private:
    bool take(std::string_view keyword, TextCursor& line) {
        if (is_axis_record(keyword)) return axes_.take(keyword, line, log_);
        if (keyword != "TYPE") return false;
        const std::uint32_t column = line.column();
        const std::string_view type = line.token();
        cells_ = same_word(type, "CELLS");
        if (!cells_ && !same_word(type, "POINTS")) log_.add("F012", line.line(), column, "TYPE: expected POINTS or CELLS");
        return true;
    }

    bool check_shape() {
        const Vec3& w = axes_.axis[2];
        if (w[0] != 0 || w[1] != 0 || w[2] == 0) {
            log_.add("F013", scanner_.frame.line, 0, "AXIS_W of a 2D grid has to be vertical");
            return false;
        }
        if (axes_.count[2] != 1) {
            log_.add("F008", scanner_.frame.line, 0,
                     [&] { return "a 2D grid has one layer, but AXIS_N says " + std::to_string(axes_.count[2]); });
            return false;
        }
        if (cells_ && (axes_.count[0] < 2 || axes_.count[1] < 2)) {
            log_.add("F008", scanner_.frame.line, 0, "a grid with TYPE CELLS needs at least 2 by 2 corners");
            return false;
        }
        return true;
    }

    static void move_to_centres(Raster& raster) {
        for (std::size_t d = 0; d < 2; ++d) {
            --raster.dims[d];
            for (std::size_t c = 0; c < 3; ++c) raster.origin[c] += raster.step[d][c] / 2;
        }
        raster.info.annotations.push_back({"gocad.grid2d_type", "CELLS"});
    }

    // z = O + i U + j V + value W, turned up. Values stay in their type where that is exact.
    static void heights_to_elevation(Raster& raster) {
        const bool depth = raster.info.crs.z_positive == ZPositive::depth;
        const double base = raster.origin[2], su = raster.step[0][2], sv = raster.step[1][2], w = raster.step[2][2];
        const double sign = depth ? -1.0 : 1.0;
        Attribute& height = raster.info.attributes.front();
        const auto elevation = [&](double value, std::size_t sample) {
            const double i = static_cast<double>(sample % raster.dims[0]);
            const double j = static_cast<double>(sample / raster.dims[0]);
            return sign * (base + i * su + j * sv + w * value);
        };
        if (base == 0 && su == 0 && sv == 0 && std::abs(w) == 1) {
            const bool turn = sign * w < 0;
            if (auto* floats = std::get_if<std::vector<float>>(&height.values)) {
                for (float& v : *floats) {
                    if (turn && !is_no_data(height, v)) v = -v;
                }
            } else if (auto* doubles = std::get_if<std::vector<double>>(&height.values)) {
                for (double& v : *doubles) {
                    if (turn && !is_no_data(height, v)) v = -v;
                }
            } else if (turn) to_doubles(height, elevation);
        } else to_doubles(height, elevation);
        raster.origin[2] = 0;
        raster.step[0][2] = raster.step[1][2] = 0;
        raster.step[2] = {0, 0, 1};
        raster.height_attribute = 0;
    }

    template <class Elevation>
    static void to_doubles(Attribute& height, const Elevation& elevation) {
        std::vector<double> values(value_count(height));
        for (std::size_t s = 0; s < values.size(); ++s) {
            const double v = value_as_double(height, s);
            values[s] = is_no_data(height, v) || std::isnan(v) ? v : elevation(v, s);
        }
        height.values = std::move(values);
    }

    ObjectScanner& scanner_;
    ObjectLog& log_;
    ArrayObject object_;
    ObjectHead& head_ = object_.head;
    CompanionFiles& files_ = object_.files;
    LatticeAxes& axes_ = object_.axes;
    IndexedPropertyList& properties_ = object_.properties;
    bool cells_ = false;
};

}  // namespace

Result<void> read_grid2d(ObjectScanner& scanner) { return Grid2dReader(scanner).run(); }

}  // namespace geomend::gocad
