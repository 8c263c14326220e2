// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/gocad/array_properties.h"

#include <cmath>

#include "base/text_cursor.h"
#include "formats/drop.h"
#include "formats/gocad/array_codec.h"
#include "formats/gocad/ascii_data_file.h"
#include "model/objects.h"

namespace geomend::gocad {

namespace {

bool on_cells(const IndexedProperty& p, const ArrayPlace& place) {
    return p.alignment.empty() ? place.cells_by_default : same_word(p.alignment, "CELLS");
}

// Text has no types; a stated storage type says what the values are.
template <class Value>
AttributeValues narrowed(const std::vector<double>& values) {
    std::vector<Value> out;
    out.reserve(values.size());
    for (const double v : values) out.push_back(static_cast<Value>(v));
    return out;
}

AttributeValues typed(std::vector<double> values, const IndexedProperty& p, ArrayStorage storage) {
    using enum ArrayStorage;
    if (p.storage_type.empty()) return values;
    // Values that the type does not hold stay what they are.
    if (storage != float32 && !array_fits(values, storage)) return values;
    switch (storage) {
        case float32:
            return narrowed<float>(values);
        case int8:
            return narrowed<std::int8_t>(values);
        case rgba:
        case uint8:
            return narrowed<std::uint8_t>(values);
        case int16:
            return narrowed<std::int16_t>(values);
        case uint16:
            return narrowed<std::uint16_t>(values);
        case int32:
            return narrowed<std::int32_t>(values);
        case uint32:
            return narrowed<std::uint32_t>(values);
        default:
            return values;
    }
}

void tell_missing_values(const IndexedProperty& p, ObjectScanner& scanner) {
    scanner.log.add(
        "F119", p.line, 0, [&] { return "property '" + p.attribute.name + "' has no values: it names no file"; }, p.attribute.name);
    list_dropped(scanner.losses,
                 {LossClass::identity, p.attribute.name, "a property without values", "the file declares it, but gives no values"});
}

class Reader {
public:
    Reader(const ArrayPlace& place, CompanionFiles& files, ObjectScanner& scanner) : place_(place), files_(files), scanner_(scanner) {}

    // From the property's own binary file.
    bool binary(IndexedProperty& p, ArrayStorage storage) {
        const std::uint64_t count = on_cells(p, place_) ? place_.cells : sample_count(place_.dims);
        const std::string_view bytes = files_.bytes(p.file, p.offset, count * element_size(storage), p.file_line);
        if (files_.failed()) return false;
        p.attribute.values = decode_array(bytes, storage, count);
        return true;
    }

    // Columns of the text file, `components` of them for each property.
    bool text(std::vector<IndexedProperty*>& wanted, const std::vector<ArrayStorage>& storages, std::vector<Vec3>* positions) {
        const std::string_view bytes = files_.all(place_.ascii_file, place_.ascii_line);
        if (files_.failed()) return false;
        std::vector<std::string> names;
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            for (std::uint32_t c = 0; c < element_components(storages[i]); ++c) names.push_back(wanted[i]->attribute.name);
        }
        AsciiColumns columns;
        if (!read_ascii_data(bytes, place_.ascii_file, place_.dims, names, place_.ascii_positions, place_.ascii_line, scanner_.log,
                             columns)) {
            return false;
        }
        std::size_t next = 0;
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            const std::uint32_t components = element_components(storages[i]);
            wanted[i]->attribute.values =
                typed(interleaved(columns, next, components, on_cells(*wanted[i], place_)), *wanted[i], storages[i]);
            next += components;
        }
        if (positions != nullptr) *positions = std::move(columns.positions);
        return true;
    }

private:
    std::vector<double> interleaved(AsciiColumns& columns, std::size_t first, std::uint32_t components, bool cells) const {
        const auto& dims = place_.dims;
        std::vector<double> values;
        values.reserve((cells ? place_.cells : sample_count(dims)) * components);
        std::uint64_t at = 0;
        for (std::uint32_t k = 0; k < dims[2]; ++k) {
            for (std::uint32_t j = 0; j < dims[1]; ++j) {
                for (std::uint32_t i = 0; i < dims[0]; ++i, ++at) {
                    // A cell's value stands in the row of its lowest node; the last layer of each direction has none.
                    const bool has_cell =
                        (i + 1 < dims[0] || dims[0] == 1) && (j + 1 < dims[1] || dims[1] == 1) && (k + 1 < dims[2] || dims[2] == 1);
                    if (cells && !has_cell) continue;
                    for (std::uint32_t c = 0; c < components; ++c) values.push_back(columns.properties[first + c][at]);
                }
            }
        }
        return values;
    }

    const ArrayPlace& place_;
    CompanionFiles& files_;
    ObjectScanner& scanner_;
};

}  // namespace

std::vector<Attribute> read_array_properties(std::vector<IndexedProperty> properties, const ArrayPlace& place, CompanionFiles& files,
                                             ObjectScanner& scanner, std::vector<Vec3>* positions) {
    Reader reader(place, files, scanner);
    std::vector<IndexedProperty*> in_text;
    std::vector<ArrayStorage> text_storages;
    std::vector<bool> has_values;
    for (IndexedProperty& p : properties) {
        has_values.push_back(false);
        auto storage = storage_of(p, scanner.input.name());
        if (!storage) {
            const Finding& why = storage.why().error;
            scanner.log.add(why.code, why.where.line, 0, why.message, p.attribute.name);
            continue;
        }
        p.attribute.location = on_cells(p, place) ? AttributeLocation::cell : AttributeLocation::point;
        p.attribute.components = element_components(*storage);
        if (*storage == ArrayStorage::rgba) p.attribute.annotations.emplace_back("gocad.storage", "RGBA");
        if (*storage == ArrayStorage::ibm32) p.attribute.annotations.emplace_back("gocad.storage", "IBM");
        if (scanner.stopped()) return {};
        if (!p.file.empty()) {
            has_values.back() = reader.binary(p, *storage);
        } else if (!place.ascii_file.empty()) {
            in_text.push_back(&p);
            text_storages.push_back(*storage);
            has_values.back() = true;
        } else tell_missing_values(p, scanner);
    }
    const bool wants_text = !in_text.empty() || (place.ascii_positions && positions != nullptr);
    if (wants_text && !scanner.log.has_error()) reader.text(in_text, text_storages, positions);
    if (scanner.log.has_error()) return {};
    std::vector<Attribute> attributes;
    for (std::size_t i = 0; i < properties.size(); ++i) {
        if (has_values[i]) attributes.push_back(std::move(properties[i].attribute));
    }
    return attributes;
}

}  // namespace geomend::gocad
