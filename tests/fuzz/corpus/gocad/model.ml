GOCAD Model3d 1
HEADER {
name:m
}
TSURF skin
TSURF frac
TFACE 1  boundary skin
  0 0 0
  0 1 0
  1 0 0
TFACE 2  fault frac
  0.1 0.1 0.1
  0.2 0.1 0.1
  0.1 0.2 0.1
REGION 3  Universe
  +1  0
REGION 4  R
  -1  +2
  -2
  0
LAYER L
  4  0
END
GOCAD TSurf 1
HEADER {
name:skin
}
TFACE
VRTX 1 0 0 0
VRTX 2 1 0 0
VRTX 3 0 1 0
VRTX 4 0 0 1
TRGL 1 3 2
TRGL 1 2 4
TRGL 2 3 4
TRGL 3 1 4
BSTONE 1
BORDER 5 1 2
END
GOCAD TSurf 1
HEADER {
name:frac
}
TFACE
VRTX 1 0.1 0.1 0.1
VRTX 2 0.2 0.1 0.1
ATOM 3 2
TRGL 1 2 3
END
