// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/vtk/xml_read.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <stdexcept>
#include <utility>

#include "base/number_text.h"
#include "base/text_cursor.h"
#include "base/wording.h"
#include "formats/drop.h"
#include "formats/vtk/vtk_merge.h"
#include "formats/vtk/vtk_structure.h"
#include "model/dataset_text.h"

namespace geomend::vtk {

namespace {

constexpr std::size_t deepest_chain = 4;
constexpr std::uint64_t most_files = 1000000;
constexpr std::uint8_t hidden_cell = 32;

std::string stem(const Input& input) {
    std::string name = input.base_name();
    const std::size_t dot = name.rfind('.');
    if (dot != std::string::npos && dot != 0) name.resize(dot);
    return name;
}

const char* variant_name(DatasetKind kind) {
    switch (kind) {
        case DatasetKind::unstructured:
            return "XML unstructured grid";
        case DatasetKind::poly:
            return "XML poly data";
        case DatasetKind::structured:
            return "XML structured grid";
        case DatasetKind::image:
            return "XML image";
        case DatasetKind::rectilinear:
            return "XML rectilinear grid";
    }
    return "";
}

// ---- one dataset ----

class DatasetReader {
public:
    DatasetReader(const XmlDocument& doc, const Input& input, const ReadOptions& options, DatasetKind kind, bool parallel)
        : doc_(doc), input_(input), options_(options), kind_(kind), parallel_(parallel) {}

    Result<Dataset> run(FileChain chain) {
        const std::string element = std::string(parallel_ ? "P" : "") + element_name(kind_);
        const XmlElement* dataset = doc_.child(doc_.root(), element);
        if (dataset == nullptr) return unreadable("F012", doc_.where(doc_.root()), "expected an element " + element + ", found none");
        dataset_ = dataset;
        auto fields = read_field_data(doc_, doc_.child(*dataset, "FieldData"));
        if (!fields) return std::move(fields).why();
        fields_ = std::move(*fields);
        auto done = parallel_ ? named_pieces(chain) : read_pieces(doc_, kind_, options_, pieces_, notes_);
        if (!done) return std::move(done).why();
        auto object = make_object();
        if (!object) return std::move(object).why();
        return finish(std::move(*object));
    }

private:
    const XmlDocument& doc_;
    const Input& input_;
    const ReadOptions& options_;
    DatasetKind kind_;
    bool parallel_;
    const XmlElement* dataset_ = nullptr;
    std::vector<Attribute> fields_;
    std::vector<Piece> pieces_;
    ReadNotes notes_;

    Result<void> named_pieces(FileChain chain) {
        for (const XmlElement* piece = doc_.child(*dataset_, "Piece"); piece != nullptr; piece = doc_.child(*dataset_, "Piece", piece)) {
            const std::string source = doc_.attribute(*piece, "Source");
            if (source.empty()) return unreadable("F012", doc_.where(*piece), "expected the name of a file in Source, found none");
            if ((*chain.files_left)-- == 0) return unreadable("F014", doc_.where(*piece), "the file names too many files");
            auto input = open_named(doc_, *piece, input_, source, notes_);
            if (!input) return std::move(input).why();
            auto document = scan_xml(input->bytes(), input->name());
            if (!document) return std::move(document).why();
            if (document->raw_attribute(document->root(), "type") != element_name(kind_))
                return unreadable("F012", document->where(document->root()),
                                  std::string("expected a VTKFile of type ") + element_name(kind_));
            if (auto done = read_pieces(*document, kind_, options_, pieces_, notes_); !done) return done;
        }
        report_announced_arrays();
        return {};
    }

    /// Arrays that the file of pieces announces and a piece has not, or has with another number of components.
    void report_announced_arrays() {
        for (const auto& [section, location] :
             {std::pair{"PPointData", AttributeLocation::point}, std::pair{"PCellData", AttributeLocation::cell}}) {
            const XmlElement* data = doc_.child(*dataset_, section);
            if (data == nullptr) continue;
            for (const XmlElement* array = doc_.child(*data, "PDataArray"); array != nullptr;
                 array = doc_.child(*data, "PDataArray", array)) {
                const std::string name = doc_.attribute(*array, "Name");
                if (name.empty()) continue;
                report_announced(name, location, doc_.where(*array));
                std::int64_t components = 1;
                const std::string stated = doc_.attribute(*array, "NumberOfComponents");
                if (stated.empty() || parse_integer(stated, components) == NumberStatus::ok)
                    report_announced_components(name, location, components, doc_.where(*array));
            }
        }
    }

    void report_announced(const std::string& name, AttributeLocation location, const Location& where) {
        const auto has_it = [&](const Piece& piece) {
            return std::ranges::any_of(piece.attributes, [&](const Attribute& a) { return a.name == name && a.location == location; });
        };
        const auto without = static_cast<std::uint64_t>(pieces_.size() - static_cast<std::size_t>(std::ranges::count_if(pieces_, has_it)));
        if (without == 0 || name == "vtkGhostType") return;
        notes_.findings.push_back(
            make_finding("F113", "array '" + name + "' is announced, but " + counted(without, "piece does", "pieces do") + " not have it",
                         where, without));
    }

    void report_announced_components(const std::string& name, AttributeLocation location, std::int64_t announced, const Location& where) {
        std::uint64_t others = 0;
        std::uint32_t first = 0;
        for (const Piece& piece : pieces_) {
            for (const Attribute& a : piece.attributes) {
                if (a.name != name || a.location != location || a.components == announced) continue;
                if (others++ == 0) first = a.components;
            }
        }
        if (others == 0) return;
        notes_.findings.push_back(make_finding("F113",
                                               "array '" + name + "' is announced with " + std::to_string(announced) +
                                                   (announced == 1 ? " component" : " components") + ", but " +
                                                   counted(others, "piece has ", "pieces have ") + std::to_string(first),
                                               where, others));
    }

    Result<Object> make_object() {
        std::size_t empty = 0;
        for (const Piece& p : pieces_) empty += p.empty_cells;
        if (empty != 0) {
            drop(notes_.findings, notes_.losses,
                 {.loss_class = LossClass::identity,
                  .what = "empty cells",
                  .why = "they have no nodes",
                  .count = empty,
                  .where = {doc_.file},
                  .code = "F119",
                  .message = std::to_string(empty) + " empty cells are left out"});
        }
        CornerCells corner_cells;
        for (const Piece& p : pieces_) {
            for (const auto& [type, count] : p.corner_cells) corner_cells[type] += count;
        }
        drop_further_points(corner_cells, {doc_.file}, notes_.findings, notes_.losses);
        if (kind_ == DatasetKind::unstructured) {
            CellMesh mesh = join_meshes(pieces_, doc_.file, notes_);
            set_kind(mesh.info);
            return Object(std::move(mesh));
        }
        if (kind_ == DatasetKind::poly) return object_from_polydata(join_polydata(pieces_, doc_.file, notes_));
        auto whole = read_extent(doc_, *dataset_, "WholeExtent");
        if (!whole) return std::move(whole).why();
        auto piece = join_lattices(pieces_, kind_, *whole, doc_.file, notes_);
        if (!piece) return std::move(piece).why();
        if (kind_ == DatasetKind::structured) return structured(std::move(*piece));
        return raster(std::move(*piece));
    }

    void set_kind(ObjectInfo& info) const { info.annotations.push_back({std::string(dataset_key), element_name(kind_)}); }

    void note_precision(ObjectInfo& info, const Piece& piece) const {
        if (piece.single_precision) info.precision = CoordinatePrecision::single_precision;
    }

    Result<Object> structured(Piece piece) {
        StructuredGrid grid;
        grid.dims = dims_of(piece.extent);
        grid.points = std::move(piece.points);
        grid.info.attributes = std::move(piece.attributes);
        set_kind(grid.info);
        note_precision(grid.info, piece);
        take_blanking(grid);
        return Object(std::move(grid));
    }

    // A ghost array that says nothing but "hidden" is our dead cells; any other stays an attribute as well.
    static void take_blanking(StructuredGrid& grid) {
        for (std::size_t i = 0; i < grid.info.attributes.size(); ++i) {
            const Attribute& a = grid.info.attributes[i];
            const auto* marks = std::get_if<std::vector<std::uint8_t>>(&a.values);
            if (a.name != "vtkGhostType" || a.location != AttributeLocation::cell || a.components != 1 || marks == nullptr) continue;
            grid.dead_cells.resize(marks->size());
            bool only = true;
            for (std::size_t c = 0; c < marks->size(); ++c) {
                grid.dead_cells[c] = ((*marks)[c] & hidden_cell) != 0 ? 1 : 0;
                only = only && ((*marks)[c] == 0 || (*marks)[c] == hidden_cell);
            }
            if (only) grid.info.attributes.erase(grid.info.attributes.begin() + static_cast<std::ptrdiff_t>(i));
            return;
        }
    }

    Result<void> three(const XmlElement& element, std::string_view name, std::span<double> to) const {
        bool found = false;
        doc_.raw_attribute(element, name, &found);
        if (!found) return {};
        const std::string text = doc_.attribute(element, name);
        TextCursor cursor(text);
        cursor.next_line();
        for (double& x : to) {
            if (cursor.real(x) != NumberStatus::ok)
                return unreadable(
                    "F005", doc_.where(element),
                    "expected " + std::to_string(to.size()) + " numbers in " + std::string(name) + ", found '" + text.substr(0, 80) + "'");
            if (!std::isfinite(x)) return unreadable("F006", doc_.where(element), std::string(name) + " is not finite");
        }
        return {};
    }

    Result<Object> raster(Piece piece) {
        Raster r;
        r.dims = dims_of(piece.extent);
        if (kind_ == DatasetKind::rectilinear) {
            r.coordinates = std::move(piece.coordinates);
            note_precision(r.info, piece);
        } else if (auto done = image_frame(piece.extent, r); !done) {
            return std::move(done).why();
        }
        r.info.attributes = std::move(piece.attributes);
        set_kind(r.info);
        return Object(std::move(r));
    }

    Result<void> image_frame(const Extent& extent, Raster& r) const {
        std::array<double, 3> spacing{1, 1, 1};
        std::array<double, 9> direction{1, 0, 0, 0, 1, 0, 0, 0, 1};
        if (auto done = three(*dataset_, "Origin", r.origin); !done) return done;
        if (auto done = three(*dataset_, "Spacing", spacing); !done) return done;
        if (auto done = three(*dataset_, "Direction", direction); !done) return done;
        for (std::size_t d = 0; d < 3; ++d) {
            for (std::size_t axis = 0; axis < 3; ++axis) r.step[d][axis] = spacing[d] * direction[3 * axis + d];
        }
        for (std::size_t d = 0; d < 3; ++d) {
            const auto first = static_cast<double>(extent[2 * d]);
            for (std::size_t axis = 0; axis < 3 && first != 0; ++axis) r.origin[axis] += first * r.step[d][axis];
        }
        return {};
    }

    Result<Dataset> finish(Object object) {
        Dataset dataset;
        dataset.format = "vtk";
        dataset.variant = std::string(variant_name(kind_)) + (parallel_ ? " in pieces" : "");
        const OwnTexts own = take_own_texts(fields_);
        ObjectInfo& info = info_of(object);
        if (info.name.empty()) info.name = stem(input_);
        std::erase_if(fields_, [](const Attribute& a) { return a.components == 0; });  // an array of nothing says nothing
        for (Attribute& a : fields_) info.attributes.push_back(std::move(a));
        std::vector<Object> several;
        if (!own.structure.empty() && !restore_structure(own.structure, object)) several = split_objects(own.structure, object);
        if (several.empty()) dataset.objects.push_back(std::move(object));
        else dataset.objects = std::move(several);
        dataset.findings = std::move(notes_.findings);
        dataset.losses = std::move(notes_.losses);
        if (!own.dataset.empty()) apply_own_text(own.dataset, dataset);
        return dataset;
    }
};

Result<Dataset> read_document(const Input& input, const ReadOptions& options, FileChain chain) {
    if (input.bytes().empty()) return unreadable("F002", {input.name()}, "the file is empty");
    auto document = scan_xml(input.bytes(), input.name());
    if (!document) return std::move(document).why();
    const XmlElement& root = document->root();
    if (root.name != "VTKFile")
        return unreadable("F012", document->where(root), "expected a VTKFile element, found " + std::string(root.name.substr(0, 40)));
    const std::string_view type = document->raw_attribute(root, "type");
    if (type == "vtkMultiBlockDataSet") return read_multiblock(*document, input, options, chain);
    if (type == "Collection") return read_collection(*document, input, options, chain);
    bool parallel = false;
    const auto kind = kind_of_type(type, parallel);
    if (!kind)
        return unreadable("F013", document->where(root), "VTK files of type '" + std::string(type.substr(0, 60)) + "' cannot be read");
    return DatasetReader(*document, input, options, *kind, parallel).run(chain);
}

}  // namespace

Result<Input> open_named(const XmlDocument& document, const XmlElement& element, const Input& input, const std::string& file,
                         ReadNotes& notes) {
    auto opened = input.companion(file);
    if (opened) return opened;
    // Copied without its folder, as happens with downloads: the same name beside this file.
    const std::string beside = file.substr(file.find_last_of('/') + 1);
    if (beside != file && !beside.empty() && !input.has_companion(file) && input.has_companion(beside)) {
        Finding finding =
            make_finding("F131", "'" + file + "' is missing: read '" + beside + "' beside the file instead", document.where(element), 0);
        notes.findings.push_back(std::move(finding));
        return input.companion(beside);
    }
    Failure why = std::move(opened).why();
    why.error.where = document.where(element);
    return why;
}

OwnTexts take_own_texts(std::vector<Attribute>& fields) {
    OwnTexts own;
    const auto take = [&](std::string_view name, std::string& to) {
        for (std::size_t i = 0; i < fields.size(); ++i) {
            auto* values = std::get_if<std::vector<std::string>>(&fields[i].values);
            if (fields[i].name != name || values == nullptr || values->size() != 1) continue;
            to = std::move(values->front());
            fields.erase(fields.begin() + static_cast<std::ptrdiff_t>(i));
            return;
        }
    };
    take(text_field, own.dataset);
    take(structure_field, own.structure);
    return own;
}

bool apply_own_text(std::string_view text, Dataset& dataset) {
    std::vector<std::vector<Annotation>> mine;
    for (Object& object : dataset.objects) mine.push_back(std::exchange(info_of(object).annotations, {}));
    const bool ours = apply_dataset_text(text, dataset);
    for (std::size_t i = 0; i < mine.size(); ++i) {
        std::vector<Annotation>& annotations = info_of(dataset.objects[i]).annotations;
        std::erase_if(annotations, [](const Annotation& a) { return a.key == dataset_key; });
        annotations.insert(annotations.end(), mine[i].begin(), mine[i].end());
    }
    return ours;
}

int sniff_xml(std::string_view head, std::string_view type) {
    const std::size_t at = head.find("<VTKFile");
    if (at == std::string_view::npos || at > 4096) return 0;
    const std::string_view tag = head.substr(at, head.find('>', at) - at);
    const std::size_t word = tag.find("type");
    if (word == std::string_view::npos) return 0;
    const std::size_t quote = tag.find_first_of("\"'", word);
    if (quote == std::string_view::npos) return 0;
    const std::string_view value = tag.substr(quote + 1, tag.find(tag[quote], quote + 1) - quote - 1);
    return value == type ? 100 : 0;
}

Result<Dataset> read_chained(const Input& input, const ReadOptions& options, FileChain chain) {
    if (chain.depth > deepest_chain) return unreadable("F014", {input.name()}, "files that name files are nested too deeply");
    ++chain.depth;
    return read_document(input, options, chain);
}

Result<Dataset> read_vtk_xml(const Input& input, const ReadOptions& options) {
    std::uint64_t files_left = most_files;
    try {
        return read_chained(input, options, {0, &files_left});
    } catch (const std::bad_alloc&) {
        return unreadable("F014", {input.name()}, "the file asks for more memory than there is");
    } catch (const std::length_error&) {
        return unreadable("F014", {input.name()}, "the file asks for more memory than there is");
    }
}

}  // namespace geomend::vtk
