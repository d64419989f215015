package io.troupe.player.structures.health;

/** Data of the Player interface health. This client does not use it. */
public class PlayerHealthData {
    private PlayerHealthCpu cpu = new PlayerHealthCpu();
    private PlayerHealthMemory mem = new PlayerHealthMemory();
    private PlayerHealthMemory swap = new PlayerHealthMemory();

    public synchronized PlayerHealthCpu getCpu() {
        return cpu;
    }

    public synchronized void setCpu(PlayerHealthCpu value) {
        cpu = value;
    }

    public synchronized PlayerHealthMemory getMem() {
        return mem;
    }

    public synchronized void setMem(PlayerHealthMemory value) {
        mem = value;
    }

    public synchronized PlayerHealthMemory getSwap() {
        return swap;
    }

    public synchronized void setSwap(PlayerHealthMemory value) {
        swap = value;
    }
}
