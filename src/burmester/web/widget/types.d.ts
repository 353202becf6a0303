// What the modules of the page hand each other, and what the server and its workers tell them.

/** Where the body is: the origin of M in F, its angle in radians, and the joints of links between joints. */
export interface Place {
  x: number;
  y: number;
  a: number;
  joints?: Record<string, number[]>;
}

/** From the plane to pixels. */
export interface View {
  scale: number;
  left: number;
  top: number;
  width: number;
  height: number;
  X(x: number): number;
  Y(y: number): number;
}
