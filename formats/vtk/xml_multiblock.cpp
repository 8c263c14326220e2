// SPDX-License-Identifier: AGPL-3.0-or-later
// .vtm: named blocks within blocks, each a file of its own.
#include <algorithm>

#include "base/wording.h"
#include "formats/drop.h"
#include "formats/vtk/vtk_models.h"
#include "formats/vtk/xml_read.h"

namespace geomend::vtk {

namespace {

class BlockReader {
public:
    BlockReader(const XmlDocument& doc, const Input& input, const ReadOptions& options, FileChain chain)
        : doc_(doc), input_(input), options_(options), chain_(chain) {}

    // The document nests at most 200 deep, so that recursion is bounded.
    Result<void> walk(const XmlElement& parent) {
        for (const XmlElement* child : doc_.children(parent)) {
            const std::string name = doc_.attribute(*child, "name");
            if (child->name == "DataSet") {
                if (auto done = data_set(*child, name); !done) return done;
            } else if (child->name == "Block" || child->name == "Piece") {
                if (!name.empty()) groups_.push_back(name);
                auto done = walk(*child);
                if (!name.empty()) groups_.pop_back();
                if (!done) return done;
            }
        }
        return {};
    }

    Dataset out;
    std::vector<std::vector<std::string>> block_paths;  ///< groups and name of each object's block

private:
    const XmlDocument& doc_;
    const Input& input_;
    const ReadOptions& options_;
    FileChain chain_;
    std::vector<std::string> groups_;

    Result<void> data_set(const XmlElement& element, const std::string& name) {
        if (options_.monitor != nullptr && options_.monitor->stopped())
            return failure(FailureKind::cancelled, "F022", {doc_.file}, "reading was stopped");
        const std::string file = doc_.attribute(element, "file");
        if (file.empty()) return {};  // an empty block
        if ((*chain_.files_left)-- == 0) return unreadable("F014", doc_.where(element), "the file names too many files");
        ReadNotes notes;
        auto input = open_named(doc_, element, input_, file, notes);
        if (!input) return std::move(input).why();
        auto read = read_chained(*input, options_, chain_);
        if (!read) return std::move(read).why();
        std::ranges::move(notes.findings, std::back_inserter(out.findings));
        for (Object& object : read->objects) {
            ObjectInfo& info = info_of(object);
            std::vector<std::string> path = groups_;
            path.push_back(name);
            if (!name.empty() && read->objects.size() == 1) info.name = name;
            info.groups.insert(info.groups.begin(), groups_.begin(), groups_.end());
            out.objects.push_back(std::move(object));
            block_paths.push_back(std::move(path));
        }
        std::ranges::move(read->findings, std::back_inserter(out.findings));
        std::ranges::move(read->losses, std::back_inserter(out.losses));
        return {};
    }
};

}  // namespace

Result<Dataset> read_multiblock(const XmlDocument& document, const Input& input, const ReadOptions& options, FileChain chain) {
    const XmlElement* blocks = document.child(document.root(), "vtkMultiBlockDataSet");
    if (blocks == nullptr)
        return unreadable("F012", document.where(document.root()), "expected an element vtkMultiBlockDataSet, found none");
    auto fields = read_field_data(document, document.child(document.root(), "FieldData"));
    if (!fields) return std::move(fields).why();
    const OwnTexts own = take_own_texts(*fields);
    BlockReader reader(document, input, options, chain);
    if (auto done = reader.walk(*blocks); !done) return std::move(done).why();
    Dataset dataset = std::move(reader.out);
    dataset.format = "vtk";
    dataset.variant = "XML multi-block";
    if (dataset.objects.empty()) return unreadable("F017", document.where(*blocks), "the file names no blocks with data");
    const auto tell_misfit = [&](Dataset& to, const std::string& model) {
        to.findings.push_back(make_finding("F113",
                                           "the blocks" + (model.empty() ? "" : " of model " + geomend::quoted(model)) +
                                               " do not fit the model that the file states: they are read as single objects",
                                           {document.file}, 0));
    };
    if (const auto words = words_of_models(own.structure)) {
        std::vector<std::string> misfits;
        Dataset models = models_from_blocks(*words, std::move(dataset), misfits);
        for (const std::string& group : misfits) tell_misfit(models, group);
        return models;
    }
    if (is_model_text(own.structure)) {
        if (auto model = model_from_blocks(own.structure, own.dataset, dataset)) return std::move(*model);
        tell_misfit(dataset, {});
        return dataset;
    }
    if (!own.dataset.empty()) apply_own_text(own.dataset, dataset);
    for (Attribute& a : *fields) {
        if (const auto* words = std::get_if<std::vector<std::string>>(&a.values)) {
            for (const std::string& word : *words) dataset.annotations.push_back({"vtk.field", a.name + ": " + word});
        } else {
            drop(dataset.findings, dataset.losses, {LossClass::identity, {}, "field array '" + a.name + "'", "it belongs to no block"});
        }
    }
    return dataset;
}

}  // namespace geomend::vtk
