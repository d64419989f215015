package io.troupe.player.structures.limb;

/** A command of an arm; no device here uses it. */
public class PlayerLimbStopCmd {}
