// How the numbers of a frame lie: the time, then for each pane some about it, and some about each of its bodies.

export const HeaderNumbers = 7 // error, heals, events re-run, bodies rewound, bytes sent, bytes received, whether a body is in the hand
export const BodyNumbers = 7 // whether it is there, where it is drawn (2), where it really is (2), its glow, whether it is in the hand
