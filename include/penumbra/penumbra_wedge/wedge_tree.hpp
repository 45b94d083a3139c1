// The tree below the wedge index: every edge and face of the casters, in boxes of boxes.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <penumbra/penumbra_wedge/lit_mesh.hpp>
#include <penumbra/penumbra_wedge/options.hpp>
#include <vector>

namespace penumbra::detail {

/// A face as points ask for it. `from_light` is its coefficient if silhouettes are seen from the light's centre.
template <class T>
struct WedgeFace {
    Vec3<T> normal;  ///< unit length
    Vec3<T> a, b, c;
    T depth_min, depth_max;
    bool solid;
    std::int8_t from_light;
};

template <class T>
Box3<T> box_of(const WedgeFace<T>& face) {
    return extend(extend(extend(empty_box<T>(), face.a), face.b), face.c);
}

/// Whether two boxes have a point in common.
template <class T>
bool touch(const Box3<T>& a, const Box3<T>& b) {
    return a.min.x <= b.max.x && a.max.x >= b.min.x && a.min.y <= b.max.y && a.max.y >= b.min.y && a.min.z <= b.max.z &&
           a.max.z >= b.min.z;
}

/// An edge from a to b and the faces on its two sides: 0 is no_face, 1 cap_face, from 2 on those of its leaf.
template <class T>
struct WedgeEdge {
    Vec3<T> a, b;
    std::uint16_t left, right;
};

/// Children follow their parent; `skip` is the first node beyond them.
template <class T>
struct WedgeNode {
    Box3<T> box;  ///< around all faces that its edges need
    Vec3<T> normal_min, normal_max;
    T offset_min, offset_max;  ///< of the faces' planes, from the middle of the box
    std::uint32_t skip = 0, first_edge = 0, first_face = 0;
    std::uint16_t edge_count = 0, face_count = 0;
    std::uint16_t owned_faces = 0;    ///< the first of its faces: each face is owned by one leaf
    std::int8_t least = 0, most = 0;  ///< coefficients of no_face and cap_face; of all faces if seen from the light
    bool mesh_root = false, piece_root = false, in_piece = false, solid = false, simple = false;
};

template <class T>
struct WedgeTree {
    static constexpr std::size_t leaf_edges = 16, most_faces = 2 * leaf_edges + 2;

    std::vector<WedgeNode<T>> nodes;
    std::vector<WedgeEdge<T>> edges;
    std::vector<WedgeFace<T>> faces;

    std::size_t bytes() const {
        return nodes.size() * sizeof(nodes[0]) + edges.size() * sizeof(edges[0]) + faces.size() * sizeof(faces[0]);
    }
};

/// Splits items in two halves along the longest axis of their boxes' middles; returns the size of the first.
template <class T, class Item>
std::size_t split_in_halves(Item* items, std::size_t count) {
    Box3<T> middles = empty_box<T>();
    for (std::size_t i = 0; i < count; ++i) middles = extend(middles, items[i].box.min + items[i].box.max);
    const Vec3<T> size = middles.max - middles.min;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    std::nth_element(items, items + count / 2, items + count, [&](const Item& a, const Item& b) {
        return a.box.min[axis] + a.box.max[axis] < b.box.min[axis] + b.box.max[axis];
    });
    return count / 2;
}

/// Builds the tree: meshes, then their pieces, then the pieces' edges, each by halves.
template <class T>
class WedgeTreeBuilder {
  public:
    WedgeTreeBuilder(const std::vector<LitMesh<T>>& lit_meshes, SilhouetteFrom from, WedgeTree<T>& tree)
        : from_(from), tree_(tree) {
        std::vector<MeshItem> meshes;
        for (const LitMesh<T>& lit : lit_meshes) {
            Box3<T> box = empty_box<T>();
            for (const glm::uvec3& f : lit.faces)
                for (int k = 0; k < 3; ++k) box = extend(box, lit.vertices[f[k]]);
            if (!lit.pieces.empty()) meshes.push_back({&lit, box});
        }
        if (!meshes.empty()) add_meshes(meshes.data(), meshes.size());
    }

  private:
    struct MeshItem {
        const LitMesh<T>* lit;
        Box3<T> box;
    };
    struct PieceItem {
        const Piece* piece;
        Box3<T> box;
    };
    struct EdgeItem {
        LitEdge edge;
        Box3<T> box;  ///< around its faces
    };

    /// A node whose children are what `add` adds.
    template <class Add>
    void add_node(const Box3<T>& box, Add&& add) {
        const std::size_t at = tree_.nodes.size();
        tree_.nodes.emplace_back();
        tree_.nodes[at].box = box;
        add(at);
        tree_.nodes[at].skip = static_cast<std::uint32_t>(tree_.nodes.size());
    }
    template <class Item, class Add>
    void add_halves(Item* items, std::size_t count, Add&& add) {
        const std::size_t half = split_in_halves<T>(items, count);
        add(items, half);
        add(items + half, count - half);
    }
    template <class Item>
    static Box3<T> box_of(const Item* items, std::size_t count) {
        Box3<T> box = empty_box<T>();
        for (std::size_t i = 0; i < count; ++i) box = join(box, items[i].box);
        return box;
    }

    void add_meshes(MeshItem* meshes, std::size_t count) {
        if (count == 1) return add_mesh(*meshes->lit);
        add_node(box_of(meshes, count), [&](std::size_t) {
            add_halves(meshes, count, [&](MeshItem* half, std::size_t n) { add_meshes(half, n); });
        });
    }
    void add_mesh(const LitMesh<T>& lit) {
        faces_.assign(lit.faces.size(), {});
        local_.assign(lit.faces.size(), 0);
        owned_.assign(lit.faces.size(), false);
        std::vector<PieceItem> pieces;
        for (const Piece& piece : lit.pieces) {
            Box3<T> box = empty_box<T>();
            for (const std::uint32_t face : piece.faces) {
                faces_[face] = make_face(lit, piece, face);
                box = join(box, face_box(face));
            }
            pieces.push_back({&piece, box});
        }
        const std::size_t root = tree_.nodes.size();
        add_pieces(lit, pieces.data(), pieces.size());
        tree_.nodes[root].mesh_root = true;
    }
    void add_pieces(const LitMesh<T>& lit, PieceItem* pieces, std::size_t count) {
        if (count == 1) return add_piece(lit, *pieces->piece);
        add_node(box_of(pieces, count), [&](std::size_t) {
            add_halves(pieces, count, [&](PieceItem* half, std::size_t n) { add_pieces(lit, half, n); });
        });
    }
    void add_piece(const LitMesh<T>& lit, const Piece& piece) {
        std::vector<EdgeItem> edges;
        edges.reserve(piece.edges.size());
        for (const LitEdge& edge : piece.edges) {
            Box3<T> box = extend(extend(empty_box<T>(), lit.vertices[edge.a]), lit.vertices[edge.b]);
            for (const std::uint32_t face : {edge.left, edge.right})
                if (face < cap_face) box = join(box, face_box(face));
            edges.push_back({edge, box});
        }
        const std::size_t root = tree_.nodes.size();
        add_edges(lit, piece, edges.data(), edges.size());
        tree_.nodes[root].piece_root = true;
    }
    void add_edges(const LitMesh<T>& lit, const Piece& piece, EdgeItem* edges, std::size_t count) {
        add_node(box_of(edges, count), [&](std::size_t at) {
            bound(piece, edges, count, tree_.nodes[at]);
            if (count <= WedgeTree<T>::leaf_edges)
                fill_leaf(lit, edges, count, tree_.nodes[at]);
            else
                add_halves(edges, count, [&](EdgeItem* half, std::size_t n) { add_edges(lit, piece, half, n); });
        });
    }

    void fill_leaf(const LitMesh<T>& lit, const EdgeItem* edges, std::size_t count, WedgeNode<T>& node) {
        std::vector<std::uint32_t> own, others;
        for (std::size_t i = 0; i < count; ++i) {
            for (const std::uint32_t face : {edges[i].edge.left, edges[i].edge.right}) {
                if (face >= cap_face || local_[face] != 0) continue;
                (owned_[face] ? others : own).push_back(face);
                local_[face] = 1;
            }
        }
        for (const std::uint32_t face : own) owned_[face] = true;
        node.owned_faces = static_cast<std::uint16_t>(own.size());
        own.insert(own.end(), others.begin(), others.end());
        node.face_count = static_cast<std::uint16_t>(own.size());
        node.first_face = static_cast<std::uint32_t>(tree_.faces.size());
        for (std::size_t i = 0; i < own.size(); ++i) {
            local_[own[i]] = static_cast<std::uint16_t>(i + 2);
            tree_.faces.push_back(faces_[own[i]]);
        }
        node.edge_count = static_cast<std::uint16_t>(count);
        node.first_edge = static_cast<std::uint32_t>(tree_.edges.size());
        const auto local = [&](std::uint32_t face) -> std::uint16_t {
            return face == no_face ? std::uint16_t(0) : face == cap_face ? std::uint16_t(1) : local_[face];
        };
        for (std::size_t i = 0; i < count; ++i) {
            const LitEdge& e = edges[i].edge;
            tree_.edges.push_back({lit.vertices[e.a], lit.vertices[e.b], local(e.left), local(e.right)});
        }
        for (const std::uint32_t face : own) local_[face] = 0;
    }

    /// The light's centre is the origin. A sheet's face that it sees edge-on counts as if it saw the front.
    static WedgeFace<T> make_face(const LitMesh<T>& lit, const Piece& piece, std::uint32_t face) {
        const glm::uvec3& f = lit.faces[face];
        const Vec3<double> normal = glm::normalize(lit.normal(face));
        const bool away = glm::dot(normal, lit.vertex(f.x)) > 0.0;
        WedgeFace<T> result;
        result.normal = Vec3<T>(normal);
        result.a = lit.vertices[f.x], result.b = lit.vertices[f.y], result.c = lit.vertices[f.z];
        result.depth_min = std::min({result.a.z, result.b.z, result.c.z});
        result.depth_max = std::max({result.a.z, result.b.z, result.c.z});
        result.solid = piece.solid;
        // the light looks the other way than the points: what it sees from the front looks away from them
        result.from_light = static_cast<std::int8_t>(piece.solid ? (away ? 0 : -1) : (away ? 1 : -1));
        return result;
    }
    Box3<T> face_box(std::uint32_t face) const {
        const WedgeFace<T>& f = faces_[face];
        return extend(extend(extend(empty_box<T>(), f.a), f.b), f.c);
    }

    void bound(const Piece& piece, const EdgeItem* edges, std::size_t count, WedgeNode<T>& node) const {
        constexpr T big = std::numeric_limits<T>::max();
        node.in_piece = true;
        node.solid = piece.solid;
        node.simple = piece.simple;
        node.normal_min = Vec3<T>(big, big, big), node.normal_max = Vec3<T>(-big, -big, -big);
        node.offset_min = big, node.offset_max = -big;
        int least = 1, most = -1;
        const Vec3<T> middle = (node.box.min + node.box.max) * T(0.5);
        const auto include = [&](int coefficient) {
            least = std::min(least, coefficient), most = std::max(most, coefficient);
        };
        for (std::size_t i = 0; i < count; ++i) {
            for (const std::uint32_t face : {edges[i].edge.left, edges[i].edge.right}) {
                if (face >= cap_face) {
                    include(face == cap_face ? -1 : 0);
                    continue;
                }
                const WedgeFace<T>& f = faces_[face];
                const T offset = glm::dot(f.normal, middle - f.a);
                node.normal_min = glm::min(node.normal_min, f.normal);
                node.normal_max = glm::max(node.normal_max, f.normal);
                node.offset_min = std::min(node.offset_min, offset);
                node.offset_max = std::max(node.offset_max, offset);
                if (from_ == SilhouetteFrom::light_center) include(f.from_light);
            }
        }
        node.least = static_cast<std::int8_t>(least), node.most = static_cast<std::int8_t>(most);
    }

    SilhouetteFrom from_;
    WedgeTree<T>& tree_;
    std::vector<WedgeFace<T>> faces_;   // of the mesh under construction
    std::vector<std::uint16_t> local_;  // of each face, its number in the leaf under construction, or 0
    std::vector<bool> owned_;           // of each face, whether a leaf owns it
};

}  // namespace penumbra::detail
