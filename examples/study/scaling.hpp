// How costs grow with the scene.
#pragma once

#include "measure.hpp"
#include "result.hpp"

namespace penumbra::study {

/// Cost of wedges against the number of spheres, as in Figure 12 of Forest, Barthe & Paulin 2006: plain wedges, blended
/// wedges, the default, and rays at the default's error. Low light, so that silhouettes overlap.
void measure_spheres(const Effort& effort, Study& study);

/// Cost of wedges against the number of triangles of a prism whose rim, and so its silhouette, stays the same: all
/// triangles are added to its caps, flat or domed.
void measure_triangles(const Effort& effort, Study& study);

/// Cost of umbra volumes against the number of triangles of a sphere.
void measure_disk_triangles(const Effort& effort, Study& study);

/// Cost of umbra volumes against the resolution of D-buffers.
void measure_resolution(const Effort& effort, Study& study);

/// Cost of a line light's maps against their number: plain, with skins, and with intervals.
void measure_line_samples(const Effort& effort, Study& study);

}  // namespace penumbra::study
