package io.troupe.player.structures.actarray;

/** Data of the Player interface actarray. This client does not use it. */
public class PlayerActarrayData {
    private int actuators_count;
    private PlayerActarrayActuator[] actuators = new PlayerActarrayActuator[0];

    public synchronized int getActuators_count() {
        return actuators_count;
    }

    public synchronized void setActuators_count(int value) {
        actuators_count = value;
    }

    public synchronized PlayerActarrayActuator[] getActuators() {
        return actuators;
    }

    public synchronized void setActuators(PlayerActarrayActuator[] value) {
        actuators = value;
    }
}
