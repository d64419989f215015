package io.troupe.player.structures;

/** The same as {@link PlayerBbox2d}, by the name that older programs use. */
public class PlayerBbox extends PlayerBbox2d {}
