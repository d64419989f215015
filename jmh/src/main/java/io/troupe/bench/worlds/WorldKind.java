package io.troupe.bench.worlds;

import io.troupe.sim.scenario.WorldSpec;
import java.util.Arrays;
import java.util.List;
import java.util.function.BiFunction;

/** The contenders. */
enum WorldKind {
    TROUPE("troupe", TroupeWorld::new),
    JBOX2D("jbox2d", Jbox2dWorld::new),
    DYN4J("dyn4j", Dyn4jWorld::new);

    private final String label;
    private final BiFunction<WorldSpec, Boolean, BenchWorld> maker;

    WorldKind(String label, BiFunction<WorldSpec, Boolean, BenchWorld> maker) {
        this.label = label;
        this.maker = maker;
    }

    String label() {
        return label;
    }

    boolean isOurs() {
        return this == TROUPE;
    }

    /** A world whose robots wander, or one whose robots stand still. */
    BenchWorld create(WorldSpec spec, boolean driving) {
        return maker.apply(spec, driving);
    }

    static WorldKind named(String label) {
        return Arrays.stream(values())
                .filter(each -> each.label.equals(label))
                .findFirst()
                .orElseThrow(() -> new IllegalArgumentException("no contender " + label + ", there are " + labels()));
    }

    static List<String> labels() {
        return Arrays.stream(values()).map(WorldKind::label).toList();
    }
}
