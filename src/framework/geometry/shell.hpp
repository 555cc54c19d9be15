// Thin pieces about a middle surface: plane, sphere and cylinder shells, sphere membrane. Points
// and lengths in m.
//
// All of them are the points within half a thickness of the middle surface (the plane shell: a disc
// of that thickness; the cylinder shell: between its end planes). The counts that decks give
// (num_radius, num_lat, ...) say how a particle method lays particles out. InputError for a
// thickness or radius that leaves no volume.
#pragma once
#include "framework/geometry/piece.hpp"

namespace sluice {

PiecePtr make_plane_shell(Vec3 center, Vec3 normal, double radius, double thickness);
PiecePtr make_sphere_shell(Vec3 origin, double radius, double thickness);
PiecePtr make_cylinder_shell(Vec3 bottom, Vec3 top, double radius, double thickness);

}  // namespace sluice
