// Silhouettes as the light's centre sees them, beside the tree that finds them.
//
// From the light's centre a silhouette is the same for all points beyond its mesh. A shader then needs no faces, and of
// the edges only those of the silhouette: it finds them in boxes of boxes of their own. Points that are not beyond a
// mesh still need its tree. C++ shares the work on faces among a tile's points instead, and reads the tree alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <penumbra/geometry.hpp>
#include <penumbra/penumbra_wedge/wedge_tree.hpp>
#include <utility>
#include <vector>

namespace penumbra::detail {

/// An edge that counts `coefficient` times for every point beyond its mesh.
template <class T>
struct FixedEdge {
    Vec3<T> a, b;
    int coefficient;
};

/// For which points a node is.
enum class WedgePoints {
    all,
    beyond,     ///< only those beyond its box, and farther from it than points may be from a face that they are on
    not_beyond  ///< only the others
};

/// A tree with silhouettes put before the meshes that they are of. `nodes` have their edges in `edges` if `is_fixed`,
/// else in the tree; `skip` counts in `nodes`.
template <class T>
struct TreeWithSilhouettes {
    struct Node {
        WedgeNode<T> node;
        bool is_fixed = false;
        WedgePoints points = WedgePoints::all;
    };
    std::vector<Node> nodes;
    std::vector<FixedEdge<T>> edges;
};

template <class T>
class SilhouetteInserter {
  public:
    SilhouetteInserter(const WedgeTree<T>& tree, bool with_silhouettes) : tree_(tree) {
        const auto count = static_cast<std::uint32_t>(tree.nodes.size());
        start_.resize(count + 1);
        for (std::uint32_t n = 0; n < count; ++n) {
            start_[n] = next();
            const bool with = with_silhouettes && tree.nodes[n].mesh_root;
            if (with) put_silhouette(n);
            result_.nodes.push_back({tree.nodes[n], false, with ? WedgePoints::not_beyond : WedgePoints::all});
            of_tree_.push_back(result_.nodes.size() - 1);
        }
        start_[count] = next();
        for (const std::size_t n : of_tree_) {
            std::uint32_t& skip = result_.nodes[n].node.skip;
            skip = start_[skip];
        }
    }
    TreeWithSilhouettes<T> result() && { return std::move(result_); }

  private:
    std::uint32_t next() const { return static_cast<std::uint32_t>(result_.nodes.size()); }

    void put_silhouette(std::uint32_t root) {
        const std::uint32_t first = next();
        put_nodes(root, tree_.nodes[root].skip);
        result_.nodes[first].points = WedgePoints::beyond;
    }
    /// Of a piece.
    std::vector<FixedEdge<T>> silhouette(std::uint32_t root) const {
        std::vector<FixedEdge<T>> found;
        for (std::uint32_t n = root; n < tree_.nodes[root].skip; ++n) {
            const WedgeNode<T>& node = tree_.nodes[n];
            for (std::size_t e = 0; e < node.edge_count; ++e) {
                const WedgeEdge<T>& edge = tree_.edges[node.first_edge + e];
                const int coefficient = of_side(node, edge.left) - of_side(node, edge.right);
                if (coefficient != 0) found.push_back({edge.a, edge.b, coefficient});
            }
        }
        return found;
    }
    int of_side(const WedgeNode<T>& leaf, std::size_t side) const {
        return side == 0 ? 0 : side == 1 ? -1 : tree_.faces[leaf.first_face + side - 2].from_light;
    }

    /// The nodes above the pieces as they are, each piece as its silhouette.
    void put_nodes(std::uint32_t begin, std::uint32_t end) {
        std::uint32_t n = begin;
        while (n < end) {
            const WedgeNode<T>& node = tree_.nodes[n];
            const std::uint32_t at = next();
            if (node.in_piece) {
                const std::vector<FixedEdge<T>> edges = silhouette(n);
                put_edges(node, edges.data(), edges.size());
            } else {
                result_.nodes.push_back({node, true, WedgePoints::all});
                put_nodes(n + 1, node.skip);
            }
            result_.nodes[at].node.box = node.box;
            result_.nodes[at].node.skip = next();
            n = node.skip;
        }
    }
    /// Edges come in the tree's order: halves of them lie together.
    void put_edges(WedgeNode<T> node, const FixedEdge<T>* edges, std::size_t count) {
        const std::uint32_t at = next();
        node.box = empty_box<T>();
        for (std::size_t i = 0; i < count; ++i) node.box = extend(extend(node.box, edges[i].a), edges[i].b);
        node.least = -1, node.most = 1;  // never passed over as having no silhouette
        node.first_edge = static_cast<std::uint32_t>(result_.edges.size());
        node.edge_count = node.face_count = node.owned_faces = 0;
        node.first_face = 0;
        const bool is_leaf = count <= leaf_edges;
        if (is_leaf) {
            node.edge_count = static_cast<std::uint16_t>(count);
            result_.edges.insert(result_.edges.end(), edges, edges + count);
        }
        result_.nodes.push_back({node, true, WedgePoints::all});
        if (!is_leaf) {
            node.mesh_root = node.piece_root = false;
            put_edges(node, edges, count / 2);
            put_edges(node, edges + count / 2, count - count / 2);
        }
        result_.nodes[at].node.skip = next();
    }

    static constexpr std::size_t leaf_edges = 8;

    const WedgeTree<T>& tree_;
    std::vector<std::uint32_t> start_;  // of each node of the tree, where it begins, its silhouette included
    std::vector<std::size_t> of_tree_;  // where each of them lies
    TreeWithSilhouettes<T> result_;
};

}  // namespace penumbra::detail
