package io.troupe.bench.worlds;

/** One way to simulate a {@link TiledScene}. A new world has read its devices once. */
interface BenchWorld {
    /**
     * Simulates {@code intervals} intervals: in each, commands from the latest readings, the physics steps, and all
     * devices.
     */
    void advance(int intervals);

    /** The latest readings; always the same object. */
    Readings readings();
}
