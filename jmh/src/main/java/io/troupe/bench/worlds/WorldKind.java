package io.troupe.bench.worlds;

import io.troupe.bench.BenchmarkCommand;
import io.troupe.sim.model.WorldSpec;
import java.util.Arrays;
import java.util.List;
import java.util.function.BiFunction;
import picocli.CommandLine.ITypeConverter;

/** The contenders. */
enum WorldKind {
    TROUPE("troupe", (spec, driving) -> new TroupeWorld(spec, driving, 1)),
    /** Reads its devices with two threads. */
    TROUPE_2("troupe-2", (spec, driving) -> new TroupeWorld(spec, driving, 2)),
    JBOX2D("jbox2d", (spec, driving) -> new Jbox2dWorld(spec, driving, false)),
    DYN4J("dyn4j", (spec, driving) -> new Dyn4jWorld(spec, driving, false)),
    /** Skips rays that can hit nothing coloured, as our simulator does. */
    JBOX2D_SPARSE("jbox2d-sparse", (spec, driving) -> new Jbox2dWorld(spec, driving, true)),
    /** See {@link #JBOX2D_SPARSE}. */
    DYN4J_SPARSE("dyn4j-sparse", (spec, driving) -> new Dyn4jWorld(spec, driving, true));

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
        return this == TROUPE || this == TROUPE_2;
    }

    /** A world whose robots wander, or one whose robots stand still. */
    BenchWorld create(WorldSpec spec, boolean driving) {
        return maker.apply(spec, driving);
    }

    static WorldKind named(String label) {
        return Arrays.stream(values())
                .filter(each -> each.label.equals(label))
                .findFirst()
                .orElseThrow(() -> BenchmarkCommand.unknown(label, labels()));
    }

    /** Converts labels. */
    static final class Converter implements ITypeConverter<WorldKind> {
        @Override
        public WorldKind convert(String label) {
            return named(label);
        }
    }

    @Override
    public String toString() {
        return label;
    }

    static List<String> labels() {
        return Arrays.stream(values()).map(WorldKind::label).toList();
    }
}
