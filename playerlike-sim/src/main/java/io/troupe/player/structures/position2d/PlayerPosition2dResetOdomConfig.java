package io.troupe.player.structures.position2d;

/** A request of the Player interface position2d, named as in the original client. */
public class PlayerPosition2dResetOdomConfig {}
