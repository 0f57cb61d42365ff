// A consumer's own header, which has the name and the guard that many have.
#ifndef Vec3_h
#define Vec3_h

struct Vec3
{
  float X, Y, Z;
};

#endif
