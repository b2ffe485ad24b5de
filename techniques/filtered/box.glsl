// A box of WIDTH texels, 1 to 8, around the middle of one of them. REACH texels to each side of that one have a part in it.

/// The part that lies in the box of the texel `offset` texels from its middle one.
float boxWeight(int offset) {
    return clamp(0.5 * WIDTH + 0.5 - float(abs(offset)), 0.0, 1.0);
}
