// The wedge index as texels of floats: what a shader reads, see shaders/penumbra/penumbra_wedge/shadow.glsl.
//
// Texel i lies at (i mod 1024, i / 1024) of an image for a sampler2D of 32-bit floats, without filtering. Numbers of
// texels are floats as well, which are exact to 2^24; 0 says "none": texel 0 is the first node's.
//
// | texel   | x, y, z                                              | w                                            |
// |---------|------------------------------------------------------|----------------------------------------------|
// | node: 0 | box.min                                              | the first node that is not below it          |
// | 1       | box.max                                              | traits, see below                            |
// | 2       | normal_min                                           | offset_min                                   |
// | 3       | normal_max                                           | offset_max                                   |
// | 4       | its first edge, the end of its edges, its first face | the end of the faces that it owns            |
// | edge: 0 | a                                                    | the face on the left, or how often it counts |
// | 1       | b                                                    | the same on the right                        |
// | face: 0 | normal                                               | depth_max                                    |
// | 1       | a                                                    | its coefficient, see below                   |
// | 2       | b                                                    | depth_min                                    |
// | 3       | c                                                    | 0                                            |
//
// Traits: mesh_root + 2 piece_root + 4 in_piece + 8 solid + 16 simple + 32 (least + 1) + 128 (most + 1), and 512 for a
// node that only points beyond it ask, 1024 for one that only others do: fixed_silhouettes.hpp. Coefficients:
// from_light for silhouettes from the light's centre; else what points that see the face's front count it. Beside an
// edge without a face something counts 0 times, −1 for a cap, or in sum what the edge of a fixed silhouette does. All
// nodes come first, in the order of the tree, then its edges, those of fixed silhouettes, then all faces. What fields
// are: wedge_tree.hpp.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <penumbra/image.hpp>
#include <penumbra/penumbra_wedge/fixed_silhouettes.hpp>
#include <penumbra/penumbra_wedge/shadow.hpp>
#include <string>
#include <vector>

namespace penumbra {

/// What a shader needs for a query: the fields of penumbra_WedgeShadow, and the texture.
struct WedgeTexels {
    static constexpr int width = 1024;

    Image<glm::vec4> texels;            ///< empty if there is no caster
    Vec2<float> half_size{0.0F, 0.0F};  ///< of the light, times `scale`
    float scale = 1.0F;                 ///< from light space to that of the texels: a power of two
    float tolerance = 0.0F;             ///< how near a face's plane passes to points that are on it, times `scale`
    int nodes = 0;                      ///< how many texels nodes take
    std::vector<glm::ivec2> meshes;     ///< the nodes of each mesh: their first texel, and that beyond their last
};

namespace detail {

/// Lays out a tree, texel by texel.
class WedgeTexelWriter {
  public:
    static constexpr std::size_t node = 5, edge = 2, face = 4;

    explicit WedgeTexelWriter(const WedgeIndex<float>& index)
        : tree_(index.tree()),
          from_light_(index.silhouette() == SilhouetteFrom::light_center),
          all_(SilhouetteInserter<float>(index.tree(), from_light_).result()) {}

    std::size_t size() const { return faces_at() + tree_.faces.size() * face; }
    std::size_t edges_at() const { return all_.nodes.size() * node; }
    std::size_t fixed_at() const { return edges_at() + tree_.edges.size() * edge; }
    std::size_t faces_at() const { return fixed_at() + all_.edges.size() * edge; }

    void write(glm::vec4* to) {
        at_ = to;
        for (const Node& n : all_.nodes) write(n);
        for (const WedgeNode<float>& n : tree_.nodes)  // edges count their faces from the first of their leaf
            for (std::size_t e = 0; e < n.edge_count; ++e) write(tree_.edges[n.first_edge + e], n.first_face);
        for (const FixedEdge<float>& e : all_.edges) write(e);
        for (const WedgeFace<float>& f : tree_.faces) write(f);
    }
    /// The nodes of each mesh, its silhouette included, as the first texel and that beyond the last.
    std::vector<glm::ivec2> meshes() const {
        std::vector<glm::ivec2> result;
        for (std::size_t n = 0; n < all_.nodes.size();) {
            if (!all_.nodes[n].node.mesh_root) {
                ++n;
                continue;
            }
            const bool two = all_.nodes[n].points == WedgePoints::beyond;
            const std::size_t end = all_.nodes[two ? all_.nodes[n].node.skip : n].node.skip;
            result.emplace_back(static_cast<int>(n * node), static_cast<int>(end * node));
            n = end;
        }
        return result;
    }

  private:
    using Node = TreeWithSilhouettes<float>::Node;

    void put(const Vec3<float>& xyz, float w) { *at_++ = glm::vec4(xyz, w); }
    static float number(std::size_t texel) { return static_cast<float>(texel); }

    void write(const Node& with) {
        const WedgeNode<float>& n = with.node;
        const int traits = int(n.mesh_root) + 2 * int(n.piece_root) + 4 * int(n.in_piece) + 8 * int(n.solid) +
                           16 * int(n.simple) + 32 * (n.least + 1) + 128 * (n.most + 1) +
                           512 * int(with.points == WedgePoints::beyond) +
                           1024 * int(with.points == WedgePoints::not_beyond);
        const std::size_t first_edge = (with.is_fixed ? fixed_at() : edges_at()) + n.first_edge * edge;
        const std::size_t first_face = faces_at() + n.first_face * face;
        put(n.box.min, number(n.skip * node));
        put(n.box.max, static_cast<float>(traits));
        put(n.normal_min, n.offset_min);
        put(n.normal_max, n.offset_max);
        put(Vec3<float>(number(first_edge), number(first_edge + n.edge_count * edge), number(first_face)),
            number(first_face + n.owned_faces * face));
    }
    void write(const WedgeEdge<float>& e, std::size_t first_face) {
        const auto beside = [&](std::size_t local) {
            return local == 0 ? 0.0F : local == 1 ? -1.0F : number(faces_at() + (first_face + local - 2) * face);
        };
        put(e.a, beside(e.left));
        put(e.b, beside(e.right));
    }
    void write(const FixedEdge<float>& e) {
        const auto count = static_cast<float>(e.coefficient);
        put(e.a, count < 0.0F ? count : 0.0F);
        put(e.b, count > 0.0F ? -count : 0.0F);
    }
    void write(const WedgeFace<float>& f) {
        put(f.normal, f.depth_max);
        put(f.a, from_light_ ? static_cast<float>(f.from_light) : f.solid ? 0.0F : 1.0F);
        put(f.b, f.depth_min);
        put(f.c, 0.0F);
    }

    const WedgeTree<float>& tree_;
    bool from_light_;
    TreeWithSilhouettes<float> all_;
    glm::vec4* at_ = nullptr;
};

/// Whether floats can number so many texels.
inline bool require_addressable(std::size_t texels) {
    return require(texels <= std::size_t(1) << 24,
                   [&] { return "a wedge index of " + std::to_string(texels) + " texels is above 16777216"; });
}

}  // namespace detail

/// The texels of a shadow's index. PENUMBRA_PENUMBRA_WEDGE_SILHOUETTE must be what the shadow's `silhouette` is; other
/// options are the shader's own. Reports an index of more than 2^24 texels; a triangle takes about 10,
/// or up to 20 with silhouettes from the light's centre.
inline WedgeTexels wedge_texels(const PenumbraWedgeShadow<float>& shadow) {
    WedgeTexels result;
    result.half_size = shadow.scaled_half_size();
    result.scale = shadow.scale();
    result.tolerance = shadow.index().tolerance();
    detail::WedgeTexelWriter writer(shadow.index());
    const std::size_t size = writer.size(), width = WedgeTexels::width;
    if (size == 0 || !detail::require_addressable(size)) return result;
    result.texels = Image<glm::vec4>(WedgeTexels::width, static_cast<int>((size + width - 1) / width));
    writer.write(result.texels.data());
    result.nodes = static_cast<int>(writer.edges_at());
    result.meshes = writer.meshes();
    return result;
}

}  // namespace penumbra
