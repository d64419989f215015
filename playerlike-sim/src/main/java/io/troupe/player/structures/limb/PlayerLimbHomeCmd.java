package io.troupe.player.structures.limb;

/** A command of the Player interface limb. This client does not use it. */
public class PlayerLimbHomeCmd {}
