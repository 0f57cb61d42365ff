#ifndef Haptics_ExactEngine_h
#define Haptics_ExactEngine_h

namespace haptics
{
/// Makes EngineKind::Exact available in this process: CGAL's AABB tree with exact comparisons of
/// float64 boxes, slower than Embree and free of its float32. Any thread, once.
///
/// This library links a part of CGAL that is under the GPL: so is every program that links it.
void EnableExactEngine();
}

#endif
