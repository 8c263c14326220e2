// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/ringmesh/archive.h"

#include <algorithm>

#include "base/zip_archive.h"
#include "formats/drop.h"

namespace geomend::ringmesh {

namespace {

constexpr std::string_view entity_file = "mesh_entities.txt", geology_file = "geological_entities.txt";
constexpr std::array kinds{EntityText::corner, EntityText::line, EntityText::surface, EntityText::region};

std::string mesh_file(EntityText::Kind kind, std::size_t number) {
    return std::string(to_string(kind)) + "_" + std::to_string(number) + ".geogram";
}

class ArchiveReader {
public:
    ArchiveReader(const Input& input, const Monitor* monitor, Dataset& data) : input_(input), monitor_(monitor), data_(data) {}

    Result<GmArchive> run() {
        out_.name = input_.name();
        auto zip = ZipArchive::open(input_);
        if (!zip) return std::move(zip).why();
        if (auto failed = texts(*zip)) return std::move(*failed);
        std::size_t used = zip->find(geology_file) == nullptr ? 1 : 2;
        for (const EntityText::Kind kind : kinds) {
            out_.meshes[kind].resize(out_.text.entities[kind].size());
            for (std::size_t i = 0; i < out_.meshes[kind].size(); ++i) {
                if (monitor_ != nullptr && monitor_->stopped())
                    return failure(FailureKind::cancelled, "F022", {input_.name()}, "reading was stopped");
                if (auto failed = mesh(*zip, kind, i, used)) return std::move(*failed);
            }
        }
        if (used < zip->entries().size())
            drop(data_.findings, data_.losses,
                 {.loss_class = LossClass::identity,
                  .what = "files of the archive",
                  .why = "no record of " + std::string(entity_file) + " names them",
                  .count = zip->entries().size() - used,
                  .where = {input_.name()}});
        return std::move(out_);
    }

private:
    const Input& input_;
    const Monitor* monitor_;
    Dataset& data_;
    GmArchive out_;

    Result<Input> text(const ZipArchive& zip, const ZipArchive::Entry& entry) const {
        auto bytes = zip.bytes(entry);
        if (!bytes) return std::move(bytes).why();
        return Input::from_memory(std::move(*bytes), input_.name() + "/" + entry.name);
    }

    std::optional<Failure> texts(const ZipArchive& zip) {
        const ZipArchive::Entry* entry = zip.find(entity_file);
        if (entry == nullptr)
            return unreadable("F012", {input_.name()},
                              "expected a file " + std::string(entity_file) + " in the ZIP archive of a RINGMesh model");
        const auto entities = text(zip, *entry);
        if (!entities) return entities.why();
        auto model = read_entity_text(*entities);
        if (!model) return std::move(model).why();
        out_.text = std::move(*model);
        const ZipArchive::Entry* geology = zip.find(geology_file);
        if (geology == nullptr) return std::nullopt;
        const auto geological = text(zip, *geology);
        if (!geological) return geological.why();
        auto records = read_geological_text(*geological);
        if (!records) return std::move(records).why();
        out_.geology = std::move(*records);
        return std::nullopt;
    }

    std::optional<Failure> mesh(const ZipArchive& zip, EntityText::Kind kind, std::size_t number, std::size_t& used) {
        const std::string file = mesh_file(kind, number);
        const ZipArchive::Entry* entry = zip.find(file);
        if (entry == nullptr) {
            if (kind == EntityText::region) return std::nullopt;
            return unreadable("F007", {input_.name() + "/" + std::string(entity_file), out_.text.entities[kind][number].line},
                              "expected the mesh " + file + " in the archive, found none");
        }
        ++used;
        const auto bytes = zip.bytes(*entry);
        if (!bytes) return bytes.why();
        auto mesh = read_geogram_mesh(*bytes, input_.name() + "/" + file, data_.losses);
        if (!mesh) return std::move(mesh).why();
        out_.meshes[kind][number] = std::move(*mesh);
        return std::nullopt;
    }
};

}  // namespace

Result<GmArchive> read_archive(const Input& input, const Monitor* monitor, Dataset& data) {
    return ArchiveReader(input, monitor, data).run();
}

std::string name_or_number(const EntityText::Entity& entity, EntityText::Kind kind, std::size_t number) {
    return entity.name.empty() ? std::string(to_string(kind)) + "_" + std::to_string(number) : entity.name;
}

}  // namespace geomend::ringmesh
