package io.troupe.player.structures.speech;

/** A command of the Player interface speech. This client does not use it. */
public class PlayerSpeechCmd {
    private int string_count;
    private char[] string = new char[0];

    public synchronized int getString_count() {
        return string_count;
    }

    public synchronized void setString_count(int value) {
        string_count = value;
    }

    public synchronized char[] getString() {
        return string;
    }

    public synchronized void setString(char[] value) {
        string = value;
    }
}
