// How much of a disk light a face sees: what silhouettes of umbra and penumbra are made of. The mesh's adjacency, loops
// and tips are the host's.
//
// Options: none
// Error:   4 epsilon of the distance from vertex to light and of the radius
// Source:  the umbra and penumbra volume paper for circular lights, eq. 1a and 1b, put right
// C++:     include/penumbra/umbra_volume/silhouette.hpp
#ifndef PENUMBRA_UMBRA_VOLUME_SILHOUETTE_GLSL
#define PENUMBRA_UMBRA_VOLUME_SILHOUETTE_GLSL

#include "../light.glsl"

// How much of the disk lies in front of a face's plane.
#define PENUMBRA_DISK_SIGHT_NONE 0
#define PENUMBRA_DISK_SIGHT_SOME 1
#define PENUMBRA_DISK_SIGHT_ALL 2

// The points of a disk light nearest to and farthest from a face: where dot(normal, p) is least and largest, on its rim.
// World space; `normal` is the face's, any length. Both are the centre for a plane parallel to the disk's.
struct penumbra_NearFarPoints {
    vec3 near, far;
};
penumbra_NearFarPoints penumbra_near_far_points(vec3 normal, penumbra_DiskLight light) {
    vec3 zero = vec3(0.0f, 0.0f, 0.0f);
    vec3 n = penumbra_normalize_or(normal, zero);
    vec3 axis = penumbra_normalize_or(light.normal, zero);
    vec3 aside = penumbra_normalize_or(cross(axis, cross(n, axis)), zero) * light.radius;
    penumbra_NearFarPoints points;
    points.near = light.center - aside;
    points.far = light.center + aside;
    return points;
}

// The least and the largest signed distance of the disk's points from a plane through `vertex`, without the points where
// they are reached. World space and unit; `unit_normal` of length 1.
struct penumbra_DiskDistances {
    float least, largest;
};
penumbra_DiskDistances penumbra_disk_distances(vec3 unit_normal, vec3 vertex, penumbra_DiskLight light) {
    vec3 axis = penumbra_normalize_or(light.normal, vec3(0.0f, 0.0f, 0.0f));
    float middle = dot(unit_normal, light.center - vertex);
    float reach = light.radius * penumbra_safe_length(cross(unit_normal, axis));
    penumbra_DiskDistances distances;
    distances.least = middle - reach;
    distances.largest = middle + reach;
    return distances;
}

// How much of the disk a face sees: all if every point lies in front of its plane by more than `tolerance`, none if no
// point does. A face without normal sees none.
int penumbra_disk_sight(vec3 unit_normal, vec3 vertex, penumbra_DiskLight light, float tolerance) {
    penumbra_DiskDistances distances = penumbra_disk_distances(unit_normal, vertex, light);
    if (distances.least > tolerance) return PENUMBRA_DISK_SIGHT_ALL;
    return distances.largest > tolerance ? PENUMBRA_DISK_SIGHT_SOME : PENUMBRA_DISK_SIGHT_NONE;
}

#endif
