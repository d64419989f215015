package io.troupe.demo.learn;

import static org.assertj.core.api.Assertions.assertThat;
import static org.junit.jupiter.api.Assumptions.assumeTrue;

import io.troupe.demo.Main;
import io.troupe.sim.learn.Observation;
import io.troupe.sim.learn.Trial;
import io.troupe.sim.worldfile.RandomWorld;
import java.io.IOException;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.stream.Collectors;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** The package in Python, {@code docs/examples/python/troupe_gym}, with Gymnasium's checker. */
@Tag("threads")
@Timeout(value = 600, threadMode = Timeout.ThreadMode.SEPARATE_THREAD)
class TroupeGymTest {
    private static final Path FOLDER = Path.of("../docs/examples/python");

    /** Prints the time, the poses and all ranges of an office with two robots, as exact numbers. */
    private static final String PRINTS_AN_OFFICE = """
            import troupe_gym
            from test_troupe_gym import turning
            with troupe_gym.Worlds(1, random="office", side=10, robots=2) as worlds:
                seen = worlds.exchange([2026])[0]
                for step in range(100):
                    for robot in range(2):
                        numbers = [seen.time_s, seen.x[robot], seen.y[robot], seen.heading[robot], *seen.ranges[robot]]
                        print(*[float(number).hex() for number in numbers])
                    seen = worlds.exchange([turning(step, 0) + turning(step, 1)])[0]
            """;

    @Test
    void testsInPython_pass_gymnasiumsCheckerAmongThem() throws Exception {
        String output = run("-m", "unittest", "-v", "test_troupe_gym");
        assertThat(output).contains("test_gymnasiums_checker_finds_nothing").endsWith("OK\n");
    }

    @Test
    void sameSeedsAndActions_giveTheObservationsOfJava_bitForBit() throws Exception {
        List<String> lines = run("-c", PRINTS_AN_OFFICE).lines().toList();
        var trial = Trial.of(seed -> RandomWorld.office(seed, 2, 2).withRobots(2));
        Observation seen = trial.reset(2026);
        assertThat(lines).hasSize(200);
        for (int step = 0; step < 100; step++) {
            for (int robot = 0; robot < 2; robot++) {
                double[] python = Arrays.stream(lines.get(2 * step + robot).split(" "))
                        .mapToDouble(Double::parseDouble)
                        .toArray();
                assertThat(Arrays.copyOf(python, 4))
                        .as("step %d", step)
                        .containsExactly(seen.timeS(), seen.x(robot), seen.y(robot), seen.headingRad(robot));
                assertThat(Arrays.copyOfRange(python, 4, python.length)).containsExactly(seen.rangesM(robot));
            }
            seen = trial.step(0.25, turnRadps(step, 0), 0.25 + 0.05, turnRadps(step, 1));
        }
    }

    /** As in {@code test_troupe_gym.py}. */
    private static double turnRadps(int step, int robot) {
        return 0.125 * ((7 * step + 3 * robot) % 11 - 5);
    }

    private static String run(String... arguments) throws Exception {
        var command = new ArrayList<>(List.of(python(), "-W", "ignore::ResourceWarning"));
        command.addAll(List.of(arguments));
        var python = new ProcessBuilder(command).directory(FOLDER.toFile()).redirectErrorStream(true);
        String java = Path.of(System.getProperty("java.home"), "bin", "java").toString();
        String troupe =
                List.of(java, "-cp", absolute(System.getProperty("java.class.path")), Main.class.getName()).stream()
                        .map(word -> "'" + word + "'")
                        .collect(Collectors.joining(" "));
        python.environment().put("TROUPE", troupe);
        python.environment().put("PYTHONDONTWRITEBYTECODE", "1");
        Process process = python.start();
        try {
            String output = new String(process.getInputStream().readAllBytes());
            assertThat(process.waitFor()).as(output).isZero();
            return output;
        } finally {
            process.destroyForcibly();
        }
    }

    private static String absolute(String classPath) {
        return Arrays.stream(classPath.split(java.io.File.pathSeparator))
                .map(entry -> Path.of(entry).toAbsolutePath().toString())
                .collect(Collectors.joining(java.io.File.pathSeparator));
    }

    /** An interpreter with Gymnasium; skips the test, with one line that gives the reason, if there is none. */
    private static String python() throws InterruptedException {
        String python = System.getProperty("troupe.python", "python3");
        boolean hasGymnasium;
        try {
            hasGymnasium = new ProcessBuilder(python, "-c", "import gymnasium.vector; gymnasium.vector.AutoresetMode")
                            .redirectError(ProcessBuilder.Redirect.DISCARD)
                            .start()
                            .waitFor()
                    == 0;
        } catch (IOException none) {
            hasGymnasium = false;
        }
        assumeTrue(
                hasGymnasium, python + " has no gymnasium (pip install gymnasium, or -Dtroupe.python=..): not tested");
        return python;
    }
}
