package io.troupe.demo;

import io.troupe.demo.crowd.CrowdTable;
import io.troupe.demo.hosts.RobotAddress;
import io.troupe.demo.table.ServiceJars;
import io.troupe.demo.terminal.Installation;
import io.troupe.demo.terminal.OptionRange;
import io.troupe.demo.terminal.WorldLoader;
import io.troupe.services.behaviour.WallFollower.CornerStyle;
import io.troupe.services.subsumption.ServiceCatalogue;
import io.troupe.services.subsumption.SubsumptionTable;
import io.troupe.sim.model.Scenario;
import io.troupe.sim.worldfile.CrowdWorld;
import java.nio.file.Path;
import org.jspecify.annotations.Nullable;
import picocli.CommandLine.Help.Visibility;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.ParameterException;
import picocli.CommandLine.Spec;

/**
 * Command line options for the world, its robots, and the table of their services: the paper's, those of files, or a
 * crowd.
 */
final class TeamOptions implements AutoCloseable {
    private static final int COLOURS = 8;
    private static final int SERVICES = 3;
    private static final double MOST_HOLD_SECONDS = 3600;
    /** A world and the table of services of its robots. */
    record Team(Scenario scenario, SubsumptionTable table) {}

    @Spec(Spec.Target.MIXEE)
    private CommandSpec spec;

    @Option(
            names = "--world",
            paramLabel = "FILE",
            description = "a .world or .cfg file; the paper's arena unless given",
            showDefaultValue = Visibility.NEVER)
    private @Nullable Path world;

    @Mixin
    private WorldLoader loader;

    @Option(
            names = "--robots",
            paramLabel = "N|HOST:PORT",
            description = {
                "N: instead of a file, a crowd of N robots in halls of 16 m. With --mode sync a round of N robots takes N readings, 5 s for 50 robots",
                "HOST:PORT: the robots of a Player server, with services on other hosts (--bus). --world then describes where they are"
            })
    private @Nullable String robots;

    @Option(
            names = "--colours",
            paramLabel = "C",
            description = "colours and states of a crowd; " + COLOURS + " unless given")
    private @Nullable Integer colours;

    @Option(
            names = "--services",
            paramLabel = "S",
            description = "different services of a crowd; " + SERVICES + " unless given")
    private @Nullable Integer services;

    @Option(
            names = "--hold",
            paramLabel = "N",
            description =
                    "simulated seconds that a state of a crowd lasts at least, since some robot of a crowd always sees another colour; 5 unless given")
    private @Nullable Double holdSeconds;

    @Option(
            names = "--table",
            paramLabel = "FILE",
            description =
                    "the table of services; the paper's unless given, or the crowd's. It specifies how walls are followed, whatever --corners does",
            showDefaultValue = Visibility.NEVER)
    private @Nullable Path table;

    @Mixin
    private ServiceJars jars;

    /**
     * Creates the team that the options select.
     *
     * @param corners how the wall follower turns at corners
     */
    Team team(CornerStyle corners) {
        ServiceCatalogue catalogue = jars.catalogue(table);
        return robots == null || isAddress(robots)
                ? ofTheFile(corners, catalogue)
                : crowd(size(robots), corners, catalogue);
    }

    /** Where the robots are, if they are not in this process. */
    @Nullable
    RobotAddress address() {
        return robots != null && isAddress(robots) ? RobotAddress.parse(spec, robots) : null;
    }

    private static boolean isAddress(String value) {
        return value.contains(":");
    }

    private int size(String value) {
        try {
            return Integer.parseInt(value);
        } catch (NumberFormatException noNumber) {
            throw new ParameterException(
                    spec.commandLine(),
                    "--robots is '" + value + "', expected a whole number, or HOST:PORT with --bus");
        }
    }

    /** Closes the service jars. Services that were loaded from them cannot be used any more. */
    @Override
    public void close() {
        jars.close();
    }

    private Team ofTheFile(CornerStyle corners, ServiceCatalogue catalogue) {
        refuseWithoutCrowd("--colours", colours);
        refuseWithoutCrowd("--services", services);
        refuseWithoutCrowd("--hold", holdSeconds);
        Path file = world == null ? Installation.world("paper-arena.world") : world;
        var services = table == null ? SubsumptionTable.ofThePaper(corners) : ServiceJars.read(spec, table, catalogue);
        return new Team(loader.read(file), services);
    }

    private void refuseWithoutCrowd(String option, @Nullable Number value) {
        if (value != null) {
            throw new ParameterException(
                    spec.commandLine(), option + " is " + value + ", but there is no crowd: expected --robots as well");
        }
    }

    private Team crowd(int size, CornerStyle corners, ServiceCatalogue catalogue) {
        if (world != null) {
            throw new ParameterException(
                    spec.commandLine(),
                    "--robots is " + size + " and --world is " + world + ", expected only one of them");
        }
        OptionRange.check(spec, "--robots", size, 1, CrowdWorld.MOST_ROBOTS);
        int states =
                OptionRange.check(spec, "--colours", colours == null ? COLOURS : colours, 1, CrowdWorld.MOST_COLOURS);
        Path file = table;
        if (file != null) {
            return new Team(CrowdWorld.scenario(size, states), read(file, size, catalogue));
        }
        int kinds = OptionRange.check(
                spec, "--services", services == null ? SERVICES : services, 1, CrowdTable.MOST_SERVICES);
        double hold = holdSeconds == null ? CrowdTable.HOLD_SECONDS : holdSeconds;
        if (!(hold >= 0) || hold > MOST_HOLD_SECONDS) {
            throw new ParameterException(
                    spec.commandLine(),
                    "--hold is " + hold + ", expected a number from 0 to " + (int) MOST_HOLD_SECONDS);
        }
        var cyclic = CrowdTable.of(size, CrowdWorld.colours(states), kinds, hold, corners);
        return new Team(CrowdWorld.scenario(size, states), cyclic);
    }

    private SubsumptionTable read(Path file, int size, ServiceCatalogue catalogue) {
        refuseBesideTable("--services", services);
        refuseBesideTable("--hold", holdSeconds);
        SubsumptionTable read = ServiceJars.read(spec, file, catalogue);
        if (read.robots() != size) {
            throw new ParameterException(
                    spec.commandLine(),
                    "--robots is " + size + ", expected " + read.robots() + " as in --table " + file);
        }
        return read;
    }

    private void refuseBesideTable(String option, @Nullable Number value) {
        if (value != null) {
            throw new ParameterException(
                    spec.commandLine(),
                    option + " is " + value + " beside --table, which specifies that by itself: expected one of them");
        }
    }
}
