package io.troupe.player.structures;

/** The same as {@link PlayerBbox2d}, under the name that older programs use. */
public class PlayerBbox extends PlayerBbox2d {
    /** Returns the argument if it already has the older type, else a copy of that type. */
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
