package io.troupe.player.structures.position2d;

/** A setting or a question of the position2d interface, by its name in the original client. */
public class PlayerPosition2dResetOdomConfig {}
