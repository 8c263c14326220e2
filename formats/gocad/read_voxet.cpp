// SPDX-License-Identifier: AGPL-3.0-or-later
#include <string>
#include <utility>

#include "formats/gocad/array_properties.h"
#include "formats/gocad/companion_files.h"
#include "formats/gocad/indexed_property.h"
#include "formats/gocad/lattice_axes.h"
#include "formats/gocad/object_head.h"
#include "formats/gocad/object_readers.h"
#include "formats/gocad/region_flags.h"

namespace geomend::gocad {

namespace {

class VoxetReader {
public:
    explicit VoxetReader(ObjectScanner& scanner) : scanner_(scanner), head_(scanner), files_(scanner) {}

    Result<void> run() {
        TextCursor line = scanner_.text();
        while (line.next_line()) {
            const std::string_view keyword = line.token();
            if (keyword.empty()) continue;
            if (auto taken = take(keyword, line); !taken) return taken;
        }
        if (auto named = properties_.check_names(scanner_.input.name()); !named) return named;
        head_.finish();
        if (!axes_.complete(3, scanner_.frame.line, scanner_.log)) return {};

        Raster raster;
        axes_.place(raster, head_.depth());
        ArrayPlace place;
        place.dims = raster.dims;
        place.ascii_file = ascii_file_;
        place.ascii_line = ascii_line_;
        head_.info.attributes = read_array_properties(std::move(properties_.properties), place, files_, scanner_, nullptr);
        read_regions(sample_count(raster.dims));
        if (scanner_.stopped()) return scanner_.stop();
        if (scanner_.log.has_error()) return {};
        files_.report_rest();
        raster.info = std::move(head_.info);
        scanner_.objects.emplace_back(std::move(raster));
        return {};
    }

private:
    Result<void> take(std::string_view keyword, TextCursor& line) {
        if (is_axis_record(keyword)) {
            head_.info.annotations.push_back({"gocad.axis", std::string(trimmed(line.line_text()))});
            axes_.take(keyword, line, scanner_.log);
            return {};
        }
        auto property = properties_.take(keyword, line, scanner_.input.name());
        if (!property) return std::move(property).why();
        if (*property) return {};
        if (keyword == "ASCII_DATA_FILE") {
            ascii_file_ = line.quoted_token();
            ascii_line_ = line.line();
        } else if (keyword.starts_with("FLAGS_") && flags_.take(keyword.substr(6), line, scanner_.log)) {
        } else if (keyword.starts_with("AXIS_") || keyword == "CLASSIFICATION") {
            head_.keep(keyword, line);
        } else head_.take(keyword, line);
        return {};
    }

    void read_regions(std::uint64_t samples) {
        if (flags_.line == 0) {
            if (!head_.regions.empty()) {
                scanner_.log.add("F119", scanner_.frame.line, 0, "regions are declared, but no file says which samples belong to them");
            }
            for (const RegionBit& region : head_.regions) {
                head_.info.annotations.push_back({"gocad.record", "REGION " + name_token(region.name) + ' ' + std::to_string(region.bit)});
            }
            return;
        }
        const std::string_view entries = flag_entries(flags_, samples, files_, scanner_.log);
        if (scanner_.log.has_error()) return;
        const auto thing = [](std::uint64_t sample) { return static_cast<std::uint32_t>(sample); };
        read_region_bits(entries, flags_.entry_size, head_.regions, flags_.line, scanner_.log, thing);
        if (scanner_.log.has_error()) return;
        if (auto rest = other_bits(entries, flags_.entry_size, head_.regions, "gocad_flags", thing)) {
            head_.info.attributes.push_back(std::move(*rest));
        }
        for (RegionBit& region : head_.regions) {
            head_.info.annotations.push_back({"gocad.region_bit", std::to_string(region.bit) + ' ' + region.name});
            head_.info.sets.push_back({std::move(region.name), AttributeLocation::point, std::move(region.members)});
        }
    }

    ObjectScanner& scanner_;
    ObjectHead head_;
    CompanionFiles files_;
    LatticeAxes axes_;
    IndexedPropertyList properties_{true};
    FlagsRecords flags_;
    std::string ascii_file_;
    std::uint64_t ascii_line_ = 0;
};

}  // namespace

/// Voxet: a lattice of samples with properties in companion files.
Result<void> read_voxet(ObjectScanner& scanner) { return VoxetReader(scanner).run(); }

}  // namespace geomend::gocad
