package io.troupe.player.structures;

/** The same as {@link PlayerBbox2d}, by the name that older programs use. */
public class PlayerBbox extends PlayerBbox2d {
    /** The rectangle itself where it has the older name already, else a copy that has. */
    public static PlayerBbox of(PlayerBbox2d box) {
        if (box instanceof PlayerBbox same) {
            return same;
        }
        var copy = new PlayerBbox();
        copy.setSw(box.getSw());
        copy.setSl(box.getSl());
        return copy;
    }
}
