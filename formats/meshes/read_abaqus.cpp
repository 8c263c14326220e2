// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/meshes/read_abaqus.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <unordered_map>

#include "base/vectors.h"
#include "base/wording.h"
#include "formats/drop.h"
#include "formats/meshes/abaqus_elements.h"
#include "formats/meshes/abaqus_motion.h"
#include "formats/meshes/deck_lines.h"
#include "formats/meshes/mesh_reading.h"
#include "formats/text_reading.h"
#include "model/cell_faces.h"

namespace geomend::meshes {

namespace {

using Members = std::vector<std::uint32_t>;

void sort_and_unite(Members& members) {
    std::ranges::sort(members);
    members.erase(std::ranges::unique(members).begin(), members.end());
}

/// Coordinates of a NODE in a cylindrical (C) or spherical (S) system, angles in degrees, as Cartesian ones.
Vec3 cartesian(const Vec3& p, char system) {
    const double turn = p[1] * std::numbers::pi / 180, up = p[2] * std::numbers::pi / 180;
    if (system == 'C') return {p[0] * std::cos(turn), p[0] * std::sin(turn), p[2]};
    return {p[0] * std::cos(turn) * std::cos(up), p[0] * std::sin(turn) * std::cos(up), p[0] * std::sin(up)};
}

/// A face of elements that a SURFACE names, waiting for all elements.
struct WaitingFace {
    std::string surface, elements, face;
    std::uint64_t line;
};

/// What a PART states, or a copy of it: where its nodes and elements stand among all.
struct Body {
    std::string name;      ///< of the part, or of the instance that is it
    std::size_t part = 0;  ///< in the order of the file, from 1
    std::uint32_t first_point = 0, end_point = 0, first_cell = 0, end_cell = 0;
    bool is_placed = false;  ///< an INSTANCE has put it somewhere
};

class Reader {
public:
    explicit Reader(const ReadOptions& options) : options_(options) {}

    Result<Dataset> run(const Input& input) {
        if (auto failed = read(input, 0)) return std::move(*failed);
        if (mesh_.points.empty()) return unreadable("F017", {input.name()}, "there are no nodes: expected *NODE with a line for each");
        end_part();
        if (auto failed = add_surfaces(input)) return std::move(*failed);
        name_bodies(input);
        if (faces_again_ > 0)
            list_dropped(data_.losses, {LossClass::style, "", "faces of *SURFACE from their other side, or again",
                                        "a surface is there once", faces_again_});
        for (auto& [name, members] : node_sets_) add_set(name, AttributeLocation::point, members);
        for (auto& [name, members] : element_sets_) {
            if (!is_entity_.contains(name)) add_set(name, AttributeLocation::cell, members);
        }
        grown_.finish();
        mesh_.info.name = name_of(input);
        data_.objects.emplace_back(std::move(mesh_));
        return std::move(data_);
    }

private:
    const ReadOptions& options_;
    GrowingMesh grown_;
    CellMesh& mesh_ = grown_.mesh;
    Dataset data_;
    std::size_t part_ = 0, parts_ = 0;  // ids count anew in each PART; part 0 is what stands outside
    std::vector<std::unordered_map<std::int64_t, std::uint32_t>> nodes_ = {{}}, elements_ = {{}};
    std::vector<Body> bodies_;               // parts and copies of them, as they come
    std::vector<std::size_t> body_of_part_;  // by part
    std::map<std::string, std::size_t> part_called_;
    std::vector<std::vector<Vec3>> stated_;  // by part: its points before an instance moved them
    std::uint64_t copied_ = 0;
    std::map<std::string, Members> node_sets_, element_sets_;             // by name in upper case: either case is the same
    std::map<std::pair<std::size_t, std::string>, std::int64_t> tag_of_;  // of entities, by part and name
    std::set<std::string> is_entity_;
    std::unordered_map<std::uint32_t, const AbaqusElement*> collapsed_;  // what elements are that name nodes several times
    std::vector<WaitingFace> faces_;
    std::set<std::vector<std::uint32_t>> faces_taken_;  // by their nodes: a surface that was there from its other side
    std::uint64_t faces_again_ = 0;
    std::set<std::string> surfaces_;

    bool is_stopped(std::uint64_t line) const { return line % 16384 == 0 && options_.monitor != nullptr && options_.monitor->stopped(); }

    std::optional<Failure> read(const Input& input, int depth) {
        constexpr int deepest = 16;
        if (depth > deepest) return unreadable("F014", {input.name()}, "files include each other more than 16 deep");
        DeckLines lines(input.bytes());
        auto kind = lines.next();
        while (kind != DeckLines::Kind::end) {
            if (is_stopped(lines.line())) return stopped(input);
            if (kind == DeckLines::Kind::data) {  // before the first keyword
                return unreadable("F012", {input.name(), lines.line()},
                                  "expected a keyword behind a '*', found " + shown(lines.fields().front()));
            }
            const DeckKeyword keyword = lines.keyword();
            std::optional<Failure> failed;
            if (keyword.word == "INCLUDE") failed = include(input, keyword, depth);
            if (failed) return failed;
            if (auto wrong = block(input, keyword, lines, kind)) return wrong;
        }
        return std::nullopt;
    }

    std::optional<Failure> include(const Input& input, const DeckKeyword& keyword, int depth) {
        if (keyword.value("INPUT").empty())
            return unreadable("F012", {input.name(), keyword.line}, "expected *INCLUDE, INPUT=FILE, found no file");
        auto found = input.companion(keyword.value("INPUT"));
        if (!found) return std::move(found).why();
        return read(*found, depth + 1);
    }

    /// Goes over the lines of data behind a keyword; `kind` is that of the line behind them.
    std::optional<Failure> block(const Input& input, const DeckKeyword& keyword, DeckLines& lines, DeckLines::Kind& kind) {
        const auto each_line = [&](const auto& body) -> std::optional<Failure> {
            while ((kind = lines.next()) == DeckLines::Kind::data) {
                if (is_stopped(lines.line())) return stopped(input);
                if (std::optional<Failure> failed = body()) return failed;
            }
            return std::nullopt;
        };
        if (keyword.word == "NODE") return each_line([&] { return node(input, keyword, lines); });
        if (keyword.word == "ELEMENT") return elements(input, keyword, lines, kind);
        if (keyword.word == "NSET" && keyword.has("ELSET")) add_nodes_of_elements(keyword);
        if (keyword.word == "NSET" || keyword.word == "ELSET") return each_line([&] { return set_line(input, keyword, lines); });
        if (keyword.word == "SURFACE" && (!keyword.has("TYPE") || upper_case(keyword.value("TYPE")) == "ELEMENT"))
            return each_line([&] { return surface_line(keyword, lines); });
        if (keyword.word == "INSTANCE") return instance(input, keyword, lines, kind);
        if (keyword.word == "PART") begin_part(keyword);
        if (keyword.word == "END PART") end_part();
        if (auto failed = each_line([] { return std::optional<Failure>(); })) return failed;
        leave_out(keyword);
        return std::nullopt;
    }

    std::uint32_t point_count() const { return static_cast<std::uint32_t>(mesh_.points.size()); }
    std::uint32_t cell_count() const { return static_cast<std::uint32_t>(mesh_.types.size()); }

    void begin_part(const DeckKeyword& keyword) {
        end_part();
        part_ = ++parts_;
        nodes_.resize(parts_ + 1);
        elements_.resize(parts_ + 1);
        stated_.resize(parts_ + 1);
        body_of_part_.resize(parts_ + 1, bodies_.size());
        part_called_.try_emplace(upper_case(keyword.value("NAME")), parts_);
        bodies_.push_back({std::string(keyword.value("NAME")), part_, point_count(), point_count(), cell_count(), cell_count(), false});
    }

    void end_part() {
        if (part_ == 0) return;
        bodies_.back().end_point = point_count();
        bodies_.back().end_cell = cell_count();
        part_ = 0;
    }

    /// INSTANCE: a line with a shift, a line with two points of an axis and an angle; both may be missing.
    std::optional<Failure> instance(const Input& input, const DeckKeyword& keyword, DeckLines& lines, DeckLines::Kind& kind) {
        end_part();
        AbaqusMotion motion;
        std::array<double, 7> turn{};
        const Location where{input.name(), keyword.line};
        for (int line = 0; (kind = lines.next()) == DeckLines::Kind::data; ++line) {
            if (line == 0) {
                if (auto failed = numbers_of_line(input, lines, motion.shift)) return failed;
            } else if (line == 1) {
                if (auto failed = numbers_of_line(input, lines, turn)) return failed;
                motion.on_axis = {turn[0], turn[1], turn[2]};
                motion.axis = {turn[3] - turn[0], turn[4] - turn[1], turn[5] - turn[2]};
                motion.degrees = turn[6];
                const double square = dot(motion.axis, motion.axis);
                if (motion.degrees != 0 && (!(square > 0) || !std::isfinite(square)))
                    return unreadable("F012", {input.name(), lines.line()}, "expected two points of the axis of a rotation, found no line");
            } else {
                return unreadable("F012", {input.name(), lines.line()},
                                  "expected two lines behind *INSTANCE at most, a translation and a rotation, found a third");
            }
        }
        const std::string part = upper_case(keyword.value("PART")), name(keyword.value("NAME"));
        const auto at = part_called_.find(part);
        if (at == part_called_.end()) {
            drop(data_.findings, data_.losses,
                 {.what = "an instance of the part '" + std::string(keyword.value("PART")) + "'",
                  .why = "that part is not stated before",
                  .where = where});
            return std::nullopt;
        }
        Body& body = bodies_[body_of_part_[at->second]];
        if (body.is_placed) return copy(where, body, name, motion);
        stated_[body.part].assign(mesh_.points.begin() + body.first_point, mesh_.points.begin() + body.end_point);
        body.name = name;
        body.is_placed = true;
        return move(where, body, motion);
    }

    std::optional<Failure> numbers_of_line(const Input& input, const DeckLines& lines, std::span<double> values) const {
        for (std::size_t k = 0; k < values.size() && k < lines.fields().size(); ++k) {
            const std::string_view text = lines.fields()[k];
            if (text.empty()) continue;  // 0, as the program has it
            const NumberStatus status = parse_real(text, values[k]);
            if (status == NumberStatus::ok && std::isfinite(values[k])) continue;
            return unreadable(status == NumberStatus::malformed ? "F005" : "F006", location_of(input, lines.cursor(), text),
                              "expected a number, found " + shown(text));
        }
        return std::nullopt;
    }

    std::optional<Failure> move(const Location& where, const Body& body, const AbaqusMotion& motion) {
        for (std::uint32_t p = body.first_point; p < body.end_point; ++p) {
            mesh_.points[p] = motion.moved(stated_[body.part][p - body.first_point]);
            if (!std::ranges::all_of(mesh_.points[p], [](double x) { return std::isfinite(x); }))
                return unreadable("F006", where, "the instance lies beyond what numbers can say");
        }
        return std::nullopt;
    }

    /// A further instance of a part: its nodes and elements once more; its sets hold those of all instances.
    std::optional<Failure> copy(const Location& where, const Body& from, const std::string& name, const AbaqusMotion& motion) {
        constexpr std::uint64_t most_copied = std::uint64_t{1} << 25;
        std::uint64_t members = 0;
        for (const auto* sets : {&node_sets_, &element_sets_})
            for (const auto& [set, list] : *sets) members += list.size();
        copied_ += members + (from.end_point - from.first_point) + (from.end_cell - from.first_cell);
        if (copied_ > most_copied) return unreadable("F014", where, "instances of parts have more nodes and elements than can be taken");
        Body to{name, from.part, point_count(), 0, cell_count(), 0, true};
        to.end_point = to.first_point + from.end_point - from.first_point;
        to.end_cell = to.first_cell + from.end_cell - from.first_cell;
        mesh_.points.resize(to.end_point);
        std::map<std::uint32_t, std::uint32_t> entities;  // those of the copy by those of the part
        const std::size_t key = std::numeric_limits<std::size_t>::max() - bodies_.size();
        for (std::uint32_t cell = from.first_cell; cell < from.end_cell; ++cell) {
            Members nodes(mesh_.cell_nodes(cell).begin(), mesh_.cell_nodes(cell).end());
            for (std::uint32_t& node : nodes) node += to.first_point - from.first_point;
            const auto [entity, is_new] = entities.try_emplace(mesh_.cell_entity[cell], 0);
            if (is_new) {
                const int dimension = mesh_.entities[entity->first].dimension;
                const std::string set = mesh_.entities[entity->first].name;
                const auto tag = tag_of_.try_emplace({key, upper_case(set)}, static_cast<std::int64_t>(tag_of_.size()) + 1).first;
                entity->second = grown_.entity(dimension, tag->second, set);
            }
            if (const auto at = collapsed_.find(cell); at != collapsed_.end()) collapsed_[cell_count()] = at->second;
            grown_.add(mesh_.types[cell], nodes, entity->second);
        }
        const auto add = [](Members& list, std::uint32_t first, std::uint32_t end, std::uint32_t shift) {
            for (std::size_t n = 0, count = list.size(); n < count; ++n)
                if (list[n] >= first && list[n] < end) list.push_back(list[n] + shift);
        };
        for (auto& [set, list] : node_sets_) add(list, from.first_point, from.end_point, to.first_point - from.first_point);
        for (auto& [set, list] : element_sets_) add(list, from.first_cell, from.end_cell, to.first_cell - from.first_cell);
        bodies_.push_back(to);  // `from` is gone
        return move(where, to, motion);
    }

    /// Elements without a set are called after their instance, those of a part with several instances after both.
    void name_bodies(const Input& input) {
        const bool is_assembly = std::ranges::any_of(bodies_, &Body::is_placed), has_loose = tag_of_.contains({0, ""});
        for (const Body& body : bodies_) {
            if (is_assembly && !body.is_placed && body.end_point > body.first_point)
                drop(data_.findings, data_.losses,
                     {.loss_class = LossClass::identity,
                      .entity = body.name,
                      .what = "that a part has no instance",
                      .why = "it is read where its nodes are stated",
                      .where = {input.name()},
                      .message = "part '" + body.name + "' has no *INSTANCE: it is read where its nodes are stated"});
            const auto shared = std::ranges::count(bodies_, body.part, &Body::part);
            std::set<std::uint32_t> entities(mesh_.cell_entity.begin() + body.first_cell, mesh_.cell_entity.begin() + body.end_cell);
            for (const std::uint32_t e : entities) {
                CellMesh::Entity& entity = mesh_.entities[e];
                if (entity.name.empty() && (bodies_.size() > 1 || has_loose)) entity.name = body.name;
                else if (entity.name.empty()) entity.tag = 0;
                else if (shared > 1) entity.name = body.name + "." + entity.name;
            }
        }
    }

    /// Lists a keyword that says no mesh.
    void leave_out(const DeckKeyword& keyword) {
        static const std::set<std::string_view> silent{"INCLUDE",      "PART",         "END PART", "ASSEMBLY",
                                                       "END ASSEMBLY", "END INSTANCE", "HEADING"};
        if (silent.contains(keyword.word)) return;
        list_dropped(data_.losses, {LossClass::substance, "", "*" + keyword.word, "it says no mesh", 1});
    }

    std::optional<Failure> whole(const Input& input, const DeckLines& lines, std::size_t field, const char* what,
                                 std::int64_t& value) const {
        const std::string_view text = field < lines.fields().size() ? lines.fields()[field] : std::string_view();
        if (parse_integer(text, value) == NumberStatus::ok) return std::nullopt;
        return unreadable("F005", location_of(input, lines.cursor(), text), "expected " + std::string(what) + ", found " + shown(text));
    }

    std::optional<Failure> node(const Input& input, const DeckKeyword& keyword, DeckLines& lines) {
        std::int64_t id = 0;
        if (auto failed = whole(input, lines, 0, "the number of a node", id)) return failed;
        Vec3 p{};
        for (std::size_t k = 0; k < 3; ++k) {
            const std::string_view text = k + 1 < lines.fields().size() ? lines.fields()[k + 1] : std::string_view();
            if (text.empty()) continue;  // 0, as the program has it
            const NumberStatus status = parse_real(text, p[k]);
            if (status == NumberStatus::ok && std::isfinite(p[k])) continue;
            return unreadable(status == NumberStatus::malformed ? "F005" : "F006", location_of(input, lines.cursor(), text),
                              "expected a coordinate, found " + shown(text));
        }
        const std::string system = upper_case(keyword.value("SYSTEM"));
        if (system == "C" || system == "S") p = cartesian(p, system[0]);
        const auto [at, is_new] = nodes_[part_].try_emplace(id, static_cast<std::uint32_t>(mesh_.points.size()));
        if (is_new) {
            if (mesh_.points.size() + 1 >= no_index)
                return unreadable("F014", {input.name(), lines.line()}, "more nodes than can be numbered");
            mesh_.points.push_back(p);
        } else {
            mesh_.points[at->second] = p;
            drop(data_.findings, data_.losses,
                 {.what = "the first statement of a node that is there twice",
                  .why = "the last one holds",
                  .where = {input.name(), lines.line()}});
        }
        if (keyword.has("NSET")) node_sets_[upper_case(keyword.value("NSET"))].push_back(at->second);
        return std::nullopt;
    }

    std::optional<Failure> elements(const Input& input, const DeckKeyword& keyword, DeckLines& lines, DeckLines::Kind& kind) {
        const std::string type = upper_case(keyword.value("TYPE"));
        const AbaqusElement* row = abaqus_element_called(type);
        std::uint64_t unknown = 0;
        std::vector<std::int64_t> numbers;  // an element may take several lines
        std::uint64_t begun = 0;            // on which line it begins
        while ((kind = lines.next()) == DeckLines::Kind::data) {
            if (is_stopped(lines.line())) return stopped(input);
            if (row == nullptr) {
                ++unknown;
                continue;
            }
            for (std::size_t field = 0; field < lines.fields().size(); ++field) {
                if (numbers.empty()) begun = lines.line();
                if (auto failed = whole(input, lines, field, "a node of an element", numbers.emplace_back())) return failed;
                if (numbers.size() <= row->order.size()) continue;
                const std::size_t left = lines.fields().size() - field - 1;
                if (begun != lines.line() && left > 0 && !lines.fields()[field + 1].empty()) {
                    return unreadable("F008", {input.name(), begun},
                                      "element " + std::to_string(numbers.front()) + " has too few nodes: expected " +
                                          std::to_string(row->order.size()) + " of " + type + "; the line after it has " +
                                          counted(left, "number", "numbers") + " more than it lacks, and is the next element");
                }
                if (auto failed = element(input, keyword, *row, lines.line(), numbers)) return failed;
                numbers.clear();
                break;  // the programs pass over what follows on the line
            }
        }
        if (!numbers.empty())
            return unreadable("F008", {input.name(), lines.line()},
                              "element " + std::to_string(numbers.front()) + " has " + std::to_string(numbers.size() - 1) +
                                  " nodes: expected " + std::to_string(row->order.size()) + " of " + type);
        if (unknown > 0)
            drop(data_.findings, data_.losses,
                 {.what = "elements of the type '" + type + "'",
                  .why = "it is not among those that are known",
                  .count = unknown,
                  .where = {input.name(), keyword.line}});
        return std::nullopt;
    }

    std::optional<Failure> element(const Input& input, const DeckKeyword& keyword, const AbaqusElement& stated, std::uint64_t line,
                                   std::span<const std::int64_t> numbers) {
        const AbaqusElement* collapsed = stated.type == CellType::hexahedron ? abaqus_collapsed(numbers.subspan(1)) : nullptr;
        const AbaqusElement& row = collapsed != nullptr ? *collapsed : stated;
        std::array<std::uint32_t, 20> cell{};
        for (std::size_t k = 0; k < row.order.size(); ++k) {
            const auto at = nodes_[part_].find(numbers[k + 1]);
            if (at == nodes_[part_].end())
                return unreadable("F007", {input.name(), line},
                                  "element " + std::to_string(numbers[0]) + " names node " + std::to_string(numbers[k + 1]) +
                                      ", which is not stated before");
            cell[row.order[k]] = at->second;
        }
        const auto number = static_cast<std::uint32_t>(mesh_.types.size());
        const auto [at, is_new] = elements_[part_].try_emplace(numbers[0], number);
        if (!is_new) return replace(input, at->second, numbers[0], row, line, cell);
        if (collapsed != nullptr) collapsed_[number] = collapsed;
        grown_.add(row.type, std::span(cell).first(node_count(row.type)),
                   entity_of(dimension(row.type), std::string(keyword.value("ELSET"))));
        if (keyword.has("ELSET")) element_sets_[upper_case(keyword.value("ELSET"))].push_back(number);
        return std::nullopt;
    }

    /// An element that is stated again: the last statement holds, as in the programs.
    std::optional<Failure> replace(const Input& input, std::uint32_t number, std::int64_t id, const AbaqusElement& row, std::uint64_t line,
                                   const std::array<std::uint32_t, 20>& cell) {
        if (mesh_.types[number] != row.type)
            return unreadable("F009", {input.name(), line}, "element " + std::to_string(id) + " is there twice, with two types");
        std::copy_n(cell.begin(), node_count(row.type), mesh_.nodes.begin() + static_cast<std::ptrdiff_t>(mesh_.offsets[number]));
        drop(data_.findings, data_.losses,
             {.what = "the first statement of an element that is there twice", .why = "the last one holds", .where = {input.name(), line}});
        return std::nullopt;
    }

    std::uint32_t entity_of(int dimension, const std::string& name) {
        if (!name.empty()) is_entity_.insert(upper_case(name));
        const bool is_loose = name.empty() && part_ == 0;
        const auto [at, is_new] =
            tag_of_.try_emplace({part_, upper_case(name)}, is_loose ? 0 : static_cast<std::int64_t>(tag_of_.size()) + 1);
        return grown_.entity(dimension, at->second, name);
    }

    /// NSET=..., ELSET=...: the nodes of the elements of a set.
    void add_nodes_of_elements(const DeckKeyword& keyword) {
        Members& members = node_sets_[upper_case(keyword.value("NSET"))];
        for (const std::uint32_t element : element_sets_[upper_case(keyword.value("ELSET"))])
            members.insert(members.end(), mesh_.cell_nodes(element).begin(), mesh_.cell_nodes(element).end());
        sort_and_unite(members);
    }

    /// Numbers, names of other sets, or first, last and step.
    std::optional<Failure> set_line(const Input& input, const DeckKeyword& keyword, DeckLines& lines) {
        const bool of_nodes = keyword.word == "NSET";
        auto& sets = of_nodes ? node_sets_ : element_sets_;
        const std::string_view name = keyword.value(of_nodes ? "NSET" : "ELSET");
        if (name.empty()) {
            list_dropped(data_.losses, {LossClass::substance, std::string(keyword.word), "set without a name", "nothing can refer to it"});
            return std::nullopt;
        }
        Members& members = sets[upper_case(name)];
        const Body* body = nullptr;
        if (keyword.has("INSTANCE")) {
            const std::string wanted = upper_case(keyword.value("INSTANCE"));
            const auto at = std::ranges::find_if(bodies_, [&](const Body& b) { return b.is_placed && upper_case(b.name) == wanted; });
            if (at == bodies_.end()) {
                list_dropped(data_.losses, {LossClass::substance, std::string(name), "set of an instance", "the instance is not stated"});
                return std::nullopt;
            }
            body = &*at;
        }
        const std::size_t part = body != nullptr ? body->part : part_;
        const auto& known = of_nodes ? nodes_[part] : elements_[part];
        std::uint32_t shift = 0;  // from the first instance of the part to this one
        if (body != nullptr) {
            const Body& first = bodies_[body_of_part_[body->part]];
            shift = of_nodes ? body->first_point - first.first_point : body->first_cell - first.first_cell;
        }
        std::uint64_t missing = 0;
        const auto add = [&](std::int64_t id) {
            const auto at = known.find(id);
            if (at == known.end()) ++missing;
            else members.push_back(at->second + shift);
        };
        if (keyword.has("GENERATE")) {
            std::int64_t first = 0, last = 0, step = 1;
            if (auto failed = whole(input, lines, 0, "the first number of a set", first)) return failed;
            if (auto failed = whole(input, lines, 1, "the last number of a set", last)) return failed;
            if (lines.fields().size() > 2 && !lines.fields()[2].empty())
                if (auto failed = whole(input, lines, 2, "the step of a set", step)) return failed;
            const std::uint64_t reach = last < first ? 0 : static_cast<std::uint64_t>(last) - static_cast<std::uint64_t>(first);
            if (step < 1 || last < first || reach / static_cast<std::uint64_t>(step) > known.size() * 16 + 1000000)
                return unreadable("F012", {input.name(), lines.line()},
                                  "expected first, last and a step, found numbers that do not ascend, or too many");
            for (std::uint64_t n = 0; n <= reach / static_cast<std::uint64_t>(step); ++n)
                add(static_cast<std::int64_t>(static_cast<std::uint64_t>(first) + n * static_cast<std::uint64_t>(step)));
            missing = 0;  // a range may have gaps
        } else {
            for (const std::string_view field : lines.fields()) {
                std::int64_t id = 0;
                if (parse_integer(field, id) == NumberStatus::ok) {
                    add(id);
                    continue;
                }
                const auto other = sets.find(upper_case(field));
                if (other == sets.end()) ++missing;
                else if (&other->second != &members) {
                    members.insert(members.end(), other->second.begin(), other->second.end());
                    sort_and_unite(members);  // sets of sets of sets would grow without end
                }
            }
        }
        if (missing > 0)
            drop(data_.findings, data_.losses,
                 {.what = "members of sets", .why = "they are not stated before", .count = missing, .where = {input.name(), lines.line()}});
        return std::nullopt;
    }

    std::optional<Failure> surface_line(const DeckKeyword& keyword, DeckLines& lines) {
        const auto& fields = lines.fields();
        surfaces_.insert(upper_case(keyword.value("NAME")));
        faces_.push_back({std::string(keyword.value("NAME")), std::string(fields[0]),
                          fields.size() > 1 ? upper_case(fields[1]) : std::string(), lines.line()});
        return std::nullopt;
    }

    std::optional<Failure> add_surfaces(const Input& input) {
        std::uint64_t unknown = 0, first_line = 0;
        for (const WaitingFace& waiting : faces_) {
            Members elements;
            std::int64_t id = 0;
            const auto set = element_sets_.find(upper_case(waiting.elements));
            if (set != element_sets_.end()) elements = set->second;
            else if (parse_integer(waiting.elements, id) == NumberStatus::ok) {
                for (const auto& part : elements_) {
                    const auto at = part.find(id);
                    if (at != part.end()) elements.push_back(at->second);
                }
            }
            std::uint64_t added = 0;
            const std::string surface = surface_of_side(waiting.surface);
            for (const std::uint32_t element : elements) added += add_face(element, waiting.face, surface) ? 1 : 0;
            if (added > 0 && added == elements.size()) continue;
            if (unknown == 0) first_line = waiting.line;
            unknown += std::max<std::uint64_t>(1, elements.size() - added);
        }
        if (unknown > 0)
            drop(data_.findings, data_.losses,
                 {.what = "faces of *SURFACE",
                  .why = "their element or face is not known",
                  .count = unknown,
                  .where = {input.name(), first_line}});
        return std::nullopt;
    }

    /// A surface of which both sides are stated as "X_front" and "X_back", or as hanging wall and footwall, is X; with a number where that
    /// is another one.
    std::string surface_of_side(const std::string& name) const {
        const auto is_there = [this](const std::string& surface) { return surfaces_.contains(upper_case(surface)); };
        for (const auto& [one, other] : {std::pair("_front", "_back"), std::pair("_hanging_wall", "_footwall")}) {
            for (const std::string suffix : {one, other}) {
                if (!name.ends_with(suffix)) continue;
                const std::string whole = name.substr(0, name.size() - suffix.size());
                if (!is_there(whole + one) || !is_there(whole + other)) continue;
                std::string free = whole;
                for (int n = 2; is_there(free); ++n) free = whole + "_" + std::to_string(n);
                return free;
            }
        }
        return name;
    }

    bool add_face(std::uint32_t element, std::string_view stated_face, const std::string& surface) {
        const auto collapsed = collapsed_.find(element);
        const AbaqusElement* row = collapsed != collapsed_.end() ? collapsed->second : abaqus_element_of(mesh_.types[element]);
        std::int64_t wanted = 0;
        if (row == nullptr || !stated_face.starts_with('S') || parse_integer(stated_face.substr(1), wanted) != NumberStatus::ok)
            return false;
        const auto face = std::ranges::find(row->faces, wanted);
        if (face == row->faces.end()) return false;
        std::vector<std::uint32_t> nodes, key;
        for (const std::uint8_t corner : faces_of(row->type)[static_cast<std::size_t>(face - row->faces.begin())].corners())
            nodes.push_back(mesh_.cell_nodes(element)[corner]);
        key = nodes;
        std::ranges::sort(key);
        if (!faces_taken_.insert(std::move(key)).second) {
            ++faces_again_;
            return true;
        }
        grown_.add(nodes.size() == 3 ? CellType::triangle : CellType::quad, nodes, entity_of(2, surface));
        return true;
    }

    void add_set(const std::string& name, AttributeLocation location, Members& members) {
        sort_and_unite(members);
        if (!members.empty()) mesh_.info.sets.push_back({name, location, std::move(members)});
    }
};

}  // namespace

int sniff_abaqus(std::string_view head, std::string_view base_name) {
    DeckLines lines(head);
    if (lines.next() != DeckLines::Kind::keyword) return 0;
    static const std::set<std::string_view> first{"HEADING",  "NODE",    "PART", "INCLUDE", "PARAMETER",
                                                  "PREPRINT", "ELEMENT", "NSET", "ASSEMBLY"};
    if (!first.contains(lines.keyword().word)) return 0;
    return lower_case(base_name).ends_with(".inp") ? 95 : 70;
}

Result<Dataset> read_abaqus(const Input& input, const ReadOptions& options) {
    auto data = Reader(options).run(input);
    if (!data) return data;
    data->format = "mesh";
    data->variant = "Abaqus";
    tell_missing_line_end(input, *data);
    return data;
}

}  // namespace geomend::meshes
