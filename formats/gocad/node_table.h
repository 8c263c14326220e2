// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/gocad/node_ids.h"
#include "formats/gocad/object_head.h"
#include "formats/gocad/value_columns.h"

namespace geomend::gocad {

/// Ids beyond this are refused as malformed, so that sums of ids and counts never overflow.
inline constexpr std::int64_t largest_id = 4'000'000'000'000'000'000;

/// The nodes of one object: VRTX, PVRTX, ATOM, PATOM, SHAREDVRTX, SHAREDPVRTX lines, with ids, values and twins.
/// Forward references are fine; they are resolved by finish().
class NodeTable {
public:
    /// \param head   gives the property lists (read before the first node) and takes attributes and sets at the end
    NodeTable(ObjectScanner& scanner, ObjectHead& head) : scanner_(scanner), head_(head) {}

    std::vector<Vec3> points;
    std::vector<std::uint32_t> alias;  ///< after finish(): as in Surface; empty where there are no atoms

    /// Whether a keyword begins a node line; if so the line is taken. `line` stands behind the keyword.
    bool take(std::string_view keyword, TextCursor& line);

    /// The short way for a plain VRTX or PVRTX line. \param p behind the keyword
    /// \return the start of the next line, or nullptr when the line has to be given to take()
    const char* scan_vertex(const char* p, const char* end, bool with_values, std::uint64_t line);
    /// The same for ATOM and SHAREDVRTX (without values).
    const char* scan_atom(const char* p, const char* end, std::uint64_t line);

    std::uint32_t find(std::int64_t id) const { return ids_.find(id); }
    std::uint32_t size() const { return static_cast<std::uint32_t>(points.size()); }

    /// After the last line: positions and values of atoms (F007 for what is not there, or runs in a circle), sign of
    /// z, attributes and control flags into head.info. Cost: proportional to nodes and values.
    void finish();
    Labels take_labels() { return ids_.take_labels(); }

private:
    struct Atom {
        std::uint32_t node;
        bool own_values;
        std::int64_t reference;
        std::uint64_t line;
    };

    void begin();
    void add_id(std::int64_t id, std::uint64_t line);
    void read_vertex(TextCursor& line, bool with_values);
    void read_atom(TextCursor& line, bool with_values);
    bool read_id(TextCursor& line, std::int64_t& id, std::string_view what);
    void read_tail(TextCursor& line, bool with_values);
    void add_flag(std::string_view flag);
    void resolve_atoms();

    ObjectScanner& scanner_;
    ObjectHead& head_;
    NodeIds ids_;
    bool begun_ = false;
    ValueColumns values_;
    std::vector<Atom> atoms_;
    struct FlagSet {
        std::string flag;
        std::vector<std::uint32_t> nodes;
    };
    std::vector<FlagSet> flags_;
};

/// Writes the node lines of an object in pieces.
class NodeWriter {
public:
    /// \param labels ids as they are to be written
    NodeWriter(const std::vector<Vec3>& points, const std::vector<std::uint32_t>& alias, const Labels& labels, const ObjectInfo& info,
               std::vector<const Attribute*> attributes);

    /// Appends the lines of nodes first..last. \param shared "ATOM" or "SHAREDVRTX" (with a P where there are values)
    void append(std::string& out, std::size_t first, std::size_t last, bool light) const;

private:
    void append_flags(std::string& out, std::size_t index) const;

    const std::vector<Vec3>& points_;
    const std::vector<std::uint32_t>& alias_;
    const Labels& labels_;
    std::vector<const Attribute*> attributes_;
    std::vector<const NamedSet*> flags_;
    double sign_;
};

/// The labels to write: those given when they are all different and within bounds, else 1, 2, ...
Labels writable_labels(const Labels& labels, std::size_t count);

}  // namespace geomend::gocad
