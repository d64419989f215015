package io.troupe.player.structures.log;

/** Part of a message of the Player interface log. This client does not use it. */
public class PlayerLogSetReadRewind {}
