// SPDX-License-Identifier: AGPL-3.0-or-later
#include "validators/dresses.h"

#include <gtest/gtest.h>

#include <fstream>
#include <map>

#include "formats/gocad/write_gocad.h"
#include "pipeline/convert.h"
#include "pipeline/validate.h"
#include "validators/rewritten.h"
#include "validators/zoo_defects.h"

namespace geomend::testing {

namespace {

std::vector<Finding> judged(const Dataset& data) {
    auto checked = validators::check_models(data, {});
    return checked ? std::move(checked->findings) : std::vector<Finding>{checked.why().error};
}

/// Each triangle as four, as fine on both sides of each edge.
Dataset refined(Dataset data) {
    for (Object& object : data.objects) {
        auto& surface = std::get<Surface>(object);
        const Surface whole = surface;
        surface.points.clear();
        surface.polygons = {};
        surface.border_starts.clear();
        surface.border_corners.clear();
        const auto bounds = part_bounds(whole);
        for (std::size_t part = 0; part + 1 < bounds.size(); ++part) {
            if (!surface.parts.empty()) surface.parts[part] = {static_cast<std::uint32_t>(surface.points.size()), surface.polygons.size()};
            const std::uint32_t first = whole.parts.empty() ? 0 : whole.parts[part].first_point;
            const std::size_t last = part + 1 < whole.parts.size() ? whole.parts[part + 1].first_point : whole.points.size();
            const auto start = static_cast<std::uint32_t>(surface.points.size());
            surface.points.insert(surface.points.end(), whole.points.begin() + first,
                                  whole.points.begin() + static_cast<std::ptrdiff_t>(last));
            std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
            for (std::uint64_t t = bounds[part]; t < bounds[part + 1]; ++t) {
                std::array<std::uint32_t, 3> c{}, m{};
                for (std::size_t i = 0; i < 3; ++i) c[i] = whole.polygons.corners[3 * t + i] - first + start;
                const bool is_degenerate = c[0] == c[1] || c[1] == c[2] || c[2] == c[0];
                if (is_degenerate) {
                    surface.polygons.push_back(c);
                    continue;
                }
                for (std::size_t i = 0; i < 3; ++i) {
                    const auto [at, is_new] =
                        middles.emplace(std::minmax(c[i], c[(i + 1) % 3]), static_cast<std::uint32_t>(surface.points.size()));
                    if (is_new) {
                        const Vec3 &p = surface.points[c[i]], &q = surface.points[c[(i + 1) % 3]];
                        surface.points.push_back({(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2});
                    }
                    m[i] = at->second;
                }
                surface.polygons.push_back(std::array{c[0], m[0], m[2]});
                surface.polygons.push_back(std::array{m[0], c[1], m[1]});
                surface.polygons.push_back(std::array{m[2], m[1], c[2]});
                surface.polygons.push_back(std::array{m[0], m[1], m[2]});
            }
        }
        surface.alias.clear();
        surface.labels = {};
        surface.info.attributes.clear();
    }
    for (StatedModel& model : data.models) {
        for (auto& face : model.faces) {
            if (!face.key) continue;
            auto& [a, b, c] = *face.key;  // the triangle in the middle
            const auto half = [](const Vec3& p, const Vec3& q) { return Vec3{(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2}; };
            face.key = {half(a, b), half(b, c), half(a, c)};
        }
    }
    return data;
}

/// The surfaces without the model: parts stay, and their points.
Dataset without_model(Dataset data) {
    data.models.clear();
    for (Object& object : data.objects) std::get<Surface>(object).alias.clear();
    return data;
}

/// Loose surfaces of one part each: points of several parts at one position are one, those of one part stay as they are.
Dataset loose_of(const Dataset& data) {
    Dataset loose;
    for (const Object& object : data.objects) {
        const auto& from = std::get<Surface>(object);
        Surface to;
        to.info.name = from.info.name;
        to.info.role = from.info.role;
        std::map<std::pair<Vec3, int>, std::uint32_t> known;
        const auto bounds = part_bounds(from);
        std::vector<std::uint32_t> at(from.points.size());
        for (std::size_t part = 0; part + 1 < bounds.size(); ++part) {
            const std::size_t first = from.parts.empty() ? 0 : from.parts[part].first_point;
            const std::size_t last = part + 1 < from.parts.size() ? from.parts[part + 1].first_point : from.points.size();
            std::map<Vec3, int> here;
            for (std::size_t p = first; p < last; ++p) {
                const auto [place, is_new] =
                    known.try_emplace({from.points[p], here[from.points[p]]++}, static_cast<std::uint32_t>(to.points.size()));
                if (is_new) to.points.push_back(from.points[p]);
                at[p] = place->second;
            }
        }
        for (const std::uint32_t corner : from.polygons.corners) to.polygons.corners.push_back(at[corner]);
        loose.objects.emplace_back(std::move(to));
    }
    return loose;
}

Dataset without_roles(Dataset data) {
    int number = 0;
    for (Object& object : data.objects) {
        ObjectInfo& info = info_of(object);
        info.role = FeatureRole::unknown;
        info.role_text.clear();
        info.feature.clear();
        info.name = "s" + std::to_string(++number);
    }
    return data;
}

void write_as(const Dataset& data, const std::filesystem::path& path) {
    OutputSet files(path);
    const auto losses = path.extension() == ".ml" ? gocad::write_model3d(data, files, {}) : gocad::write_objects(data, files, {});
    ASSERT_TRUE(losses) << path;
    ASSERT_TRUE(files.commit()) << path;
}

std::vector<Finding> judged_file(const std::filesystem::path& path) {
    auto file = validate(path.string(), LoadOptions{}, validators::CheckOptions{});
    return file ? std::move(file->findings) : std::vector<Finding>{file.why().error};
}

/// By way of a Gocad file to another format.
std::vector<Finding> judged_via(const Dataset& data, const std::filesystem::path& folder, const char* first, const char* name) {
    write_as(data, folder / first);
    if (std::string_view(name) == first) return judged_file(folder / name);
    ConvertRequest request;
    request.inputs = {(folder / first).string()};
    request.output = (folder / name).string();
    request.lossy = true;
    const auto done = convert(request);
    EXPECT_TRUE(done) << name << ": " << (done ? "" : done.why().error.message);
    return done ? judged_file(folder / name) : std::vector<Finding>{};
}
std::vector<Finding> judged_as(const Dataset& data, const std::filesystem::path& folder, const char* name) {
    return judged_via(data, folder, "model.ml", name);
}

/// All triangles of a Dataset over shared points, with the number of the surface of each: what other programs make of a model.
struct Heap {
    std::vector<Vec3> points;
    std::vector<std::array<std::size_t, 3>> triangles;
    std::vector<std::size_t> surface;
};
Heap heap_of(const Dataset& data) {
    Heap heap;
    std::map<std::pair<Vec3, int>, std::size_t> known;
    for (std::size_t o = 0; o < data.objects.size(); ++o) {
        const Dataset one = [&] {
            Dataset d;
            d.objects.push_back(data.objects[o]);
            return loose_of(d);
        }();
        const auto& s = std::get<Surface>(one.objects[0]);
        std::vector<std::size_t> at;
        std::map<Vec3, int> here;
        for (const Vec3& p : s.points) {
            const auto [place, is_new] = known.try_emplace({p, here[p]++}, heap.points.size());
            if (is_new) heap.points.push_back(p);
            at.push_back(place->second);
        }
        for (std::size_t t = 0; t < s.polygons.size(); ++t) {
            const auto c = s.polygons[t];
            heap.triangles.push_back({at[c[0]], at[c[1]], at[c[2]]});
            heap.surface.push_back(o + 1);
        }
    }
    return heap;
}

void write_foreign_vtu(const Dataset& data, const std::filesystem::path& path) {
    const Heap heap = heap_of(data);
    std::ofstream out(path);
    out.precision(17);
    out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\"><UnstructuredGrid>\n"
        << "<Piece NumberOfPoints=\"" << heap.points.size() << "\" NumberOfCells=\"" << heap.triangles.size() << "\">\n<Points>"
        << "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n";
    for (const Vec3& p : heap.points) out << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
    out << "</DataArray></Points>\n<Cells><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">\n";
    for (const auto& t : heap.triangles) out << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
    out << "</DataArray><DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">\n";
    for (std::size_t t = 1; t <= heap.triangles.size(); ++t) out << 3 * t << ' ';
    out << "</DataArray><DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">\n";
    for (std::size_t t = 0; t < heap.triangles.size(); ++t) out << "5 ";
    out << "</DataArray></Cells>\n<CellData><DataArray type=\"Int32\" Name=\"surface\" format=\"ascii\">\n";
    for (const std::size_t s : heap.surface) out << s << ' ';
    out << "</DataArray></CellData>\n</Piece></UnstructuredGrid></VTKFile>\n";
}

void write_foreign_msh(const Dataset& data, const std::filesystem::path& path) {
    const Heap heap = heap_of(data);
    std::ofstream out(path);
    out.precision(17);
    out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" << heap.points.size() << '\n';
    for (std::size_t p = 0; p < heap.points.size(); ++p)
        out << p + 1 << ' ' << heap.points[p][0] << ' ' << heap.points[p][1] << ' ' << heap.points[p][2] << '\n';
    out << "$EndNodes\n$Elements\n" << heap.triangles.size() << '\n';
    for (std::size_t t = 0; t < heap.triangles.size(); ++t) {
        const auto& c = heap.triangles[t];
        out << t + 1 << " 2 2 " << heap.surface[t] << ' ' << heap.surface[t] << ' ' << c[0] + 1 << ' ' << c[1] + 1 << ' ' << c[2] + 1
            << '\n';
    }
    out << "$EndElements\n";
}

}  // namespace

const std::vector<Dress>& dresses() {
    using Folder = std::filesystem::path;
    static const std::vector<Dress> all = {
        {"as made", Left::all, [](const Dataset& d, const Folder&) { return judged(d); }},
        {"shuffled", Left::all,
         [](const Dataset& d, const Folder&) {
             Random random(5);
             return judged(shuffled(d, random));
         }},
        {"turned over", Left::all,
         [](const Dataset& d, const Folder&) {
             Random random(6);
             return judged(other_order(turned(d, random), random));
         }},
        {"rotated", Left::all, [](const Dataset& d, const Folder&) { return judged(moved(d, rotated)); }},
        {"on the map", Left::all, [](const Dataset& d, const Folder&) { return judged(on_the_map(d, 1000)); }},
        {"rotated on the map", Left::all, [](const Dataset& d, const Folder&) { return judged(on_the_map(moved(d, rotated), 1000)); }},
        {"without model", Left::no_model, [](const Dataset& d, const Folder&) { return judged(without_model(d)); }},
        {"without model, map", Left::no_model,
         [](const Dataset& d, const Folder&) { return judged(on_the_map(moved(without_model(d), rotated), 1000)); }},
        {".ts with parts", Left::no_model,
         [](const Dataset& d, const Folder& f) {
             write_as(without_model(d), f / "parts.ts");
             return judged_file(f / "parts.ts");
         }},
        {"foreign .vtu", Left::no_roles,
         [](const Dataset& d, const Folder& f) {
             write_foreign_vtu(d, f / "plain.vtu");
             return judged_file(f / "plain.vtu");
         }},
        {"foreign .msh", Left::no_roles,
         [](const Dataset& d, const Folder& f) {
             write_foreign_msh(d, f / "plain.msh");
             return judged_file(f / "plain.msh");
         }},
        {"loose .msh", Left::no_model,
         [](const Dataset& d, const Folder& f) { return judged_via(without_model(d), f, "loose.ts", "loose.msh"); }},
        {"loose .vtu", Left::no_model,
         [](const Dataset& d, const Folder& f) { return judged_via(without_model(d), f, "loose.ts", "loose.vtu"); }},
        {"refined", Left::all, [](const Dataset& d, const Folder&) { return judged(refined(d)); }},
        {"without lists", Left::no_lists, [](const Dataset& d, const Folder&) { return judged(without_lists(d)); }},
        {"loose", Left::no_model, [](const Dataset& d, const Folder&) { return judged(loose_of(d)); }},
        {"loose without roles", Left::no_roles, [](const Dataset& d, const Folder&) { return judged(without_roles(loose_of(d))); }},
        {".ml", Left::all, [](const Dataset& d, const Folder& f) { return judged_as(d, f, "model.ml"); }},
        {".ts", Left::no_model,
         [](const Dataset& d, const Folder& f) {
             write_as(loose_of(d), f / "loose.ts");
             return judged_file(f / "loose.ts");
         }},
        {".ts without roles", Left::no_roles,
         [](const Dataset& d, const Folder& f) {
             write_as(without_roles(loose_of(d)), f / "bare.ts");
             return judged_file(f / "bare.ts");
         }},
        {".msh", Left::all, [](const Dataset& d, const Folder& f) { return judged_as(d, f, "model.msh"); }},
        {".vtu", Left::all, [](const Dataset& d, const Folder& f) { return judged_as(d, f, "model.vtu"); }},
        {".vtm", Left::all, [](const Dataset& d, const Folder& f) { return judged_as(d, f, "model.vtm"); }},
    };
    return all;
}

}  // namespace geomend::testing
