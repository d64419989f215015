package io.troupe.player.structures.bumper;

/** Part of a message of the Player interface bumper. */
public class PlayerBumperGeom {
    private int bumper_def_count;
    private PlayerBumperDefine[] bumper_def = new PlayerBumperDefine[0];

    public synchronized int getBumper_def_count() {
        return bumper_def_count;
    }

    public synchronized void setBumper_def_count(int value) {
        bumper_def_count = value;
    }

    public synchronized PlayerBumperDefine[] getBumper_def() {
        return bumper_def;
    }

    public synchronized void setBumper_def(PlayerBumperDefine[] value) {
        bumper_def = value;
    }
}
