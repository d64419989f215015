package io.troupe.player.structures.position3d;

/** A request of the Player interface position3d. This client does not use it. */
public class PlayerPosition3dResetOdomConfig {}
