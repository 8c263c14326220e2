// SPDX-License-Identifier: AGPL-3.0-or-later
#include <string>
#include <utility>

#include "formats/gocad/array_object.h"
#include "formats/gocad/array_properties.h"
#include "formats/gocad/object_readers.h"
#include "formats/gocad/region_flags.h"

namespace geomend::gocad {

namespace {

class VoxetReader {
public:
    explicit VoxetReader(ObjectScanner& scanner) : scanner_(scanner), object_(scanner) {}

    Result<void> run() {
        auto whole = object_.read_records([this](std::string_view keyword, TextCursor& line) { return take(keyword, line); });
        if (!whole) return whole;
        if (!object_.axes.complete(3, scanner_.frame.line, log_)) return {};

        Raster raster;
        object_.axes.place(raster, head_.depth());
        ArrayPlace place;
        place.dims = raster.dims;
        place.ascii_file = ascii_file_;
        place.ascii_line = ascii_line_;
        head_.info.attributes = read_array_properties(std::move(object_.properties.properties), place, files_, scanner_, nullptr);
        read_regions(sample_count(raster.dims));
        if (scanner_.stopped()) return scanner_.stop();
        if (log_.has_error()) return {};
        files_.report_rest();
        raster.info = std::move(head_.info);
        scanner_.objects.emplace_back(std::move(raster));
        return {};
    }

private:
    bool take(std::string_view keyword, TextCursor& line) {
        if (is_axis_record(keyword)) {
            head_.info.annotations.push_back({"gocad.axis", std::string(trimmed(line.line_text()))});
            return object_.axes.take(keyword, line, log_);
        }
        if (keyword == "ASCII_DATA_FILE") {
            ascii_file_ = line.quoted_token();
            ascii_line_ = line.line();
            return true;
        }
        return keyword.starts_with("FLAGS_") && flags_.take(keyword.substr(6), line, log_);
    }

    void read_regions(std::uint64_t samples) {
        if (flags_.line == 0) return object_.keep_region_records("samples");
        const std::string_view entries = flag_entries(flags_, samples, files_, log_);
        if (log_.has_error()) return;
        const auto thing = [](std::uint64_t sample) { return static_cast<std::uint32_t>(sample); };
        read_region_bits(entries, flags_.entry_size, head_.regions, flags_.line, log_, thing);
        if (log_.has_error()) return;
        if (auto rest = other_bits(entries, flags_.entry_size, head_.regions, "gocad_flags", thing)) {
            head_.info.attributes.push_back(std::move(*rest));
        }
        for (RegionBit& region : head_.regions) {
            head_.info.annotations.push_back({"gocad.region_bit", std::to_string(region.bit) + ' ' + region.name});
            head_.info.sets.push_back({std::move(region.name), AttributeLocation::point, std::move(region.members)});
        }
    }

    ObjectScanner& scanner_;
    ObjectLog& log_ = scanner_.log;
    ArrayObject object_;
    ObjectHead& head_ = object_.head;
    CompanionFiles& files_ = object_.files;
    FlagsRecords flags_;
    std::string ascii_file_;
    std::uint64_t ascii_line_ = 0;
};

}  // namespace

/// Voxet: a lattice of samples with properties in companion files.
Result<void> read_voxet(ObjectScanner& scanner) { return VoxetReader(scanner).run(); }

}  // namespace geomend::gocad
