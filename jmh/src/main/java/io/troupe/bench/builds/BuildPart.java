package io.troupe.bench.builds;

import static io.troupe.bench.builds.BeforeBuild.Module.ACTOR_CORE;
import static io.troupe.bench.builds.BeforeBuild.Module.ACTOR_NATS;
import static io.troupe.bench.builds.BeforeBuild.Module.ACTOR_SERVICE;
import static io.troupe.bench.builds.BeforeBuild.Module.PLAYERLIKE_SIM;
import static io.troupe.bench.builds.BeforeBuild.Module.VERIFICATION;

import io.troupe.bench.ActorTable;
import io.troupe.bench.BenchmarkCommand;
import io.troupe.bench.BuildTable;
import io.troupe.bench.NetTable;
import io.troupe.bench.bus.BusTable;
import io.troupe.bench.worlds.WorldTable;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.EnumSet;
import java.util.List;
import java.util.Locale;
import java.util.Set;
import java.util.stream.Stream;
import org.jspecify.annotations.Nullable;
import picocli.CommandLine.ITypeConverter;

/** A part of the comparison of two builds: one table, which has separate JVMs. */
enum BuildPart {
    ACTORS("-Xmx512m", "-XX:+UseG1GC"),
    SIMULATOR("-Xmx2g", "-XX:+UseSerialGC"),
    NETS("-Xmx1g", "-XX:+UseSerialGC"),
    BUS("-Xmx512m", "-XX:+UseG1GC");

    private final List<String> jvmOptions;

    BuildPart(String... jvmOptions) {
        this.jvmOptions = List.of(jvmOptions);
    }

    /**
     * What the tables of all JVMs have in common.
     *
     * @param server the address of a NATS server; null if there is none
     */
    record Setting(
            List<Integer> robots, int threads, @Nullable String server) {
        private static final String NONE = "none";

        List<String> arguments() {
            List<String> words = new ArrayList<>();
            words.add(server == null ? NONE : server);
            words.add(Integer.toString(threads));
            robots.forEach(each -> words.add(Integer.toString(each)));
            return words;
        }

        static Setting of(List<String> arguments) {
            String server = arguments.getFirst();
            return new Setting(
                    arguments.stream().skip(2).map(Integer::valueOf).toList(),
                    Integer.parseInt(arguments.get(1)),
                    server.equals(NONE) ? null : server);
        }
    }

    /** The table; {@code jvm} is the name of the JVM in which it runs. */
    BuildTable table(Setting setting, String jvm) {
        return switch (this) {
            case ACTORS -> new ActorTable();
            case SIMULATOR -> new WorldTable(setting.robots, setting.threads);
            case NETS -> new NetTable();
            case BUS -> new BusTable(setting.server, jvm);
        };
    }

    /** The modules that it measures; they must be those of the older build. */
    Set<BeforeBuild.Module> modules(boolean overNats) {
        return switch (this) {
            case ACTORS -> EnumSet.of(ACTOR_CORE);
            case SIMULATOR -> EnumSet.of(PLAYERLIKE_SIM);
            case NETS -> EnumSet.of(VERIFICATION);
            case BUS ->
                !overNats ? EnumSet.of(ACTOR_CORE, ACTOR_SERVICE) : EnumSet.of(ACTOR_CORE, ACTOR_SERVICE, ACTOR_NATS);
        };
    }

    String[] jvmOptions() {
        return Stream.concat(jvmOptions.stream(), Stream.of("-Dslf4j.internal.verbosity=ERROR"))
                .toArray(String[]::new);
    }

    @Override
    public String toString() {
        return name().toLowerCase(Locale.ROOT);
    }

    /** Converts the names of parts. */
    static final class Converter implements ITypeConverter<BuildPart> {
        @Override
        public BuildPart convert(String name) {
            return Arrays.stream(values())
                    .filter(each -> each.toString().equals(name))
                    .findFirst()
                    .orElseThrow(() -> BenchmarkCommand.unknown(
                            name,
                            Arrays.stream(values()).map(BuildPart::toString).toList()));
        }
    }
}
