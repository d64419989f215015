package io.troupe.player.structures.localize;

/** Data of the Player interface localize. This client does not use it. */
public class PlayerLocalizeData {
    private int pending_count;
    private double pending_time;
    private int hypoths_count;
    private PlayerLocalizeHypoth[] hypoths = new PlayerLocalizeHypoth[0];

    public synchronized int getPending_count() {
        return pending_count;
    }

    public synchronized void setPending_count(int value) {
        pending_count = value;
    }

    public synchronized double getPending_time() {
        return pending_time;
    }

    public synchronized void setPending_time(double value) {
        pending_time = value;
    }

    public synchronized int getHypoths_count() {
        return hypoths_count;
    }

    public synchronized void setHypoths_count(int value) {
        hypoths_count = value;
    }

    public synchronized PlayerLocalizeHypoth[] getHypoths() {
        return hypoths;
    }

    public synchronized void setHypoths(PlayerLocalizeHypoth[] value) {
        hypoths = value;
    }
}
