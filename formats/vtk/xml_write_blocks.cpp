// SPDX-License-Identifier: AGPL-3.0-or-later
// Writing .vtm: the index by hand, its blocks through the writer of each kind.
#include <algorithm>
#include <mutex>

#include "base/parallel.h"
#include "base/xml_text.h"
#include "formats/vtk/vtk_merge.h"
#include "formats/vtk/vtk_models.h"
#include "formats/vtk/vtk_structure.h"
#include "formats/vtk/xml_names.h"
#include "formats/vtk/xml_write.h"
#include "model/dataset_text.h"

namespace geomend::vtk {

namespace {

// A string array as VTK writes it in text: the codes of its characters, and 0.
void append_field(std::string& xml, std::string_view name, std::string_view value) {
    xml += "    <Array type=\"String\" Name=\"" + std::string(name) + "\" NumberOfTuples=\"1\" format=\"ascii\">\n      ";
    for (const char c : value) {
        append_number(xml, static_cast<std::int32_t>(static_cast<signed char>(c)));
        xml.push_back(' ');
    }
    xml += "0\n    </Array>\n";
}

/// Blocks in the order of the index; blocks of one group path stand together.
class BlockWriter {
public:
    BlockWriter(OutputSet& out, const WriteOptions& options, const XmlWriteSettings& settings)
        : out_(out), options_(options), settings_(settings) {
        stem_ = xml_name(out.stem());
    }

    void add(std::vector<std::string> groups, std::string name, const Object& object) {
        blocks_.push_back({std::move(groups), std::move(name), &object, {}, {}});
    }

    Result<void> write_blocks(std::vector<Loss>& losses) {
        std::vector<std::optional<Failure>> failures(blocks_.size());
        parallel_for_each_index(blocks_.size(), [&](std::size_t i) {
            if (options_.monitor != nullptr && options_.monitor->stopped()) {
                failures[i] = failure(FailureKind::cancelled, "F022", {out_.main_path().string()}, "writing was stopped");
                return;
            }
            auto file = xml_of_object(*blocks_[i].object, settings_, blocks_[i].losses);
            if (!file) {
                failures[i] = std::move(file).why();
                return;
            }
            blocks_[i].file = stem_ + "/" + stem_ + "_" + std::to_string(i) + file->extension;
            const std::lock_guard lock(files_);
            OutputFile& companion = out_.companion(blocks_[i].file);
            companion.write(file->text);
            companion.close();
        });
        for (auto& why : failures) {
            if (!why) continue;
            if (why->error.where.file.empty()) why->error.where.file = out_.main_path().string();
            return std::move(*why);
        }
        for (Block& b : blocks_) std::ranges::for_each(b.losses, [&](Loss& l) { add_loss(losses, std::move(l)); });
        return {};
    }

    void write_index(std::string_view dataset, std::string_view structure) {
        std::string xml =
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"vtkMultiBlockDataSet\" version=\"1.0\" byte_order=\"LittleEndian\" "
            "header_type=\"UInt64\">\n"
            "  <vtkMultiBlockDataSet>\n";
        level(xml, 0, blocks_.size(), 0);
        xml += "  </vtkMultiBlockDataSet>\n";
        xml += "  <FieldData>\n";
        append_field(xml, text_field, dataset);
        if (!structure.empty()) append_field(xml, structure_field, structure);
        xml += "  </FieldData>\n</VTKFile>\n";
        out_.main_file().write(xml);
    }

private:
    struct Block {
        std::vector<std::string> groups;
        std::string name;
        const Object* object;
        std::string file;
        std::vector<Loss> losses;
    };
    OutputSet& out_;
    const WriteOptions& options_;
    const XmlWriteSettings& settings_;
    std::string stem_;
    std::vector<Block> blocks_;
    std::mutex files_;

    // Groups nest at most as deep as XML may nest when it is read.
    static constexpr std::size_t deepest = 100;

    void level(std::string& xml, std::size_t first, std::size_t last, std::size_t depth) {
        const std::string indent(2 * depth + 4, ' ');
        std::size_t index = 0;
        for (std::size_t i = first; i < last;) {
            const Block& block = blocks_[i];
            if (block.groups.size() <= depth || depth >= deepest) {
                xml += indent + "<DataSet index=\"" + std::to_string(index++) + "\" name=\"" + xml_attribute(xml_name(block.name)) +
                       "\" file=\"" + xml_attribute(block.file) + "\"/>\n";
                ++i;
                continue;
            }
            std::size_t end = i;
            while (end < last && blocks_[end].groups.size() > depth && blocks_[end].groups[depth] == block.groups[depth]) ++end;
            xml += indent + "<Block index=\"" + std::to_string(index++) + "\" name=\"" + xml_attribute(xml_name(block.groups[depth])) +
                   "\">\n";
            level(xml, i, end, depth + 1);
            xml += indent + "</Block>\n";
            i = end;
        }
    }
};

/// Which objects the B-Reps are made of, so that they are not written twice.
std::vector<bool> objects_in_breps(const Dataset& dataset) {
    std::vector<bool> used(dataset.objects.size(), false);
    const auto use = [&](std::size_t object) {
        if (object < used.size()) used[object] = true;
    };
    for (const Brep& brep : dataset.breps) {
        for (const auto& surface : brep->surfaces) use(surface.source_object);
    }
    if (dataset.breps.empty()) return used;
    for (const StatedModel& model : dataset.models) {
        for (const auto& face : model.faces) use(face.object);
    }
    for (std::size_t i = 0; i < used.size(); ++i) {
        const auto* mesh = std::get_if<CellMesh>(&dataset.objects[i]);
        if (mesh != nullptr && !mesh->entities.empty() && !mesh->cell_entity.empty()) used[i] = true;
    }
    return used;
}

}  // namespace

Result<std::vector<Loss>> write_vtm(const Dataset& dataset, OutputSet& out, const WriteOptions& options) {
    const auto settings = write_settings(options);
    if (!settings) return settings.why();
    if (out.is_stream())
        return failure(FailureKind::cannot_hold, "F021", {out.main_path().string()}, "a .vtm needs a folder for its blocks: name a file");
    std::vector<Loss> losses;
    const std::vector<bool> used = objects_in_breps(dataset);
    std::vector<ModelBlocks> models;
    for (const Brep& brep : dataset.breps) models.push_back(blocks_of_brep(*brep));
    std::vector<std::string> names;
    for (const Brep& brep : dataset.breps) names.push_back(xml_name(brep->name));
    const auto model_groups = groups_of_models(names);
    BlockWriter writer(out, options, *settings);
    for (std::size_t m = 0; m < models.size(); ++m) {
        for (const ModelBlock& block : models[m].blocks) {
            std::vector<std::string> groups{block.group};
            if (models.size() > 1) groups.insert(groups.begin(), model_groups[m]);
            writer.add(std::move(groups), block.name, block.object);
        }
    }
    std::vector<Object> others;
    std::vector<std::size_t> source;
    for (std::size_t i = 0; i < used.size(); ++i) {
        if (used[i]) continue;
        writer.add(info_of(dataset.objects[i]).groups, info_of(dataset.objects[i]).name, dataset.objects[i]);
        others.push_back(dataset.objects[i]);
        source.push_back(i);
    }
    if (models.empty() && others.empty())
        return failure(FailureKind::cannot_hold, "F021", {out.main_path().string()}, "the input holds nothing to write");
    if (auto done = writer.write_blocks(losses); !done) return std::move(done).why();
    if (models.empty()) writer.write_index(dataset_text(text_only(dataset, others, source)), {});
    else if (models.size() == 1) writer.write_index(models.front().dataset, models.front().structure);
    else writer.write_index("{}", models_text(models, model_groups));
    return losses;
}

}  // namespace geomend::vtk
