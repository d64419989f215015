package io.troupe.sim;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import io.troupe.sim.worldfile.ScenarioReader;
import java.nio.file.Path;
import java.util.Arrays;
import java.util.stream.DoubleStream;
import java.util.stream.LongStream;
import org.junit.jupiter.api.Test;

/** The distributions of the noise of Stage 4.3: means and variances of many readings, and their bounds. */
class StageNoiseTest {
    private static final int READINGS = 4000;
    private static final double DISTANCE_M = 2;

    /** Errors of one ray at a wall two metres ahead. */
    private static double[] errors(String noise) {
        var world = Specs.start("position ( size [ 0.4 0.4 0.2 ] ranger ( sensor ( range [ 0 5 ] noise [ " + noise
                + " ] ) ) )\nmodel ( pose [ 2.1 0 0 0 ] size [ 0.2 4 0.5 ] )");
        return DoubleStream.generate(
                        () -> Specs.first(world.advance()).rangersM().getFirst().getFirst() - DISTANCE_M)
                .limit(READINGS)
                .toArray();
    }

    private static double mean(double[] values) {
        return Arrays.stream(values).average().orElseThrow();
    }

    private static double variance(double[] values) {
        double mean = mean(values);
        return Arrays.stream(values)
                .map(value -> (value - mean) * (value - mean))
                .average()
                .orElseThrow();
    }

    @Test
    void constantNoise_isNormalWithTheGivenVariance() {
        double[] errors = errors("0.01 0 0");
        // standard errors of the mean and of the variance of n normal values: s / sqrt(n) and s^2 * sqrt(2 / n)
        assertThat(mean(errors)).isCloseTo(0, within(5 * 0.1 / Math.sqrt(READINGS)));
        assertThat(variance(errors)).isCloseTo(0.01, within(5 * 0.01 * Math.sqrt(2.0 / READINGS)));
        double beyond =
                Arrays.stream(errors).filter(error -> Math.abs(error) > 0.1).count() / (double) READINGS;
        assertThat(beyond).as("share beyond one standard deviation").isCloseTo(0.3173, within(0.04));
    }

    @Test
    void proportionalNoise_isUniformWithinTheWholeProportion() {
        double[] errors = errors("0 0.05 0");
        assertThat(Arrays.stream(errors).boxed()).allMatch(error -> Math.abs(error) <= 0.05 * DISTANCE_M);
        assertThat(variance(errors)).isCloseTo(0.1 * 0.1 / 3, within(0.0003));
    }

    @Test
    void angularNoise_isAShareOfTheAngleBetweenTwoRays() {
        // two rays 60 degrees apart, noise of 10 degrees = 0.1745: each is off by at most half of 60 degrees times
        // 0.1745
        String text =
                "position ( size [ 0.4 0.4 0.2 ] ranger ( sensor ( range [ 0 9 ] fov 60 samples 2 noise [ 0 0 NOISE ] ) ) )\n"
                        + "model ( pose [ 2.1 0 0 0 ] size [ 0.2 400 0.5 ] )";
        double most = Math.toRadians(30 * Math.toRadians(10));
        var world = Specs.start(text.replace("NOISE", "10"));
        double least = DISTANCE_M / Math.cos(Math.toRadians(30) - most);
        double farthest = DISTANCE_M / Math.cos(Math.toRadians(30) + most);
        double[] ranges = DoubleStream.generate(
                        () -> Specs.first(world.advance()).rangersM().getFirst().getFirst())
                .limit(500)
                .toArray();
        assertThat(Arrays.stream(ranges).boxed()).allMatch(range -> range >= least - 1e-9 && range <= farthest + 1e-9);
        assertThat(Arrays.stream(ranges).min().orElseThrow()).isCloseTo(least, within(0.01));
        assertThat(Arrays.stream(ranges).max().orElseThrow()).isCloseTo(farthest, within(0.01));
    }

    @Test
    void rayThatHitsNothing_hasNoNoise() {
        var world = Specs.start("position ( size [ 0.4 0.4 0.2 ] ranger ( sensor ( noise [ 0.1 0.1 0 ] ) ) )");
        assertThat(Specs.first(world.advance()).rangersM().getFirst()).containsExactly(5.0);
    }

    @Test
    void odometryErrors_overManyRuns_areUniformWithinHalfOfTheGivenShare() {
        String text = "position ( size [ 0.4 0.4 0.2 ] localization \"odom\" odom_error [ 0.1 0 0 0 ] )";
        var spec = ScenarioReader.readText(text, Path.of("t.world")).world();
        double[] errors = LongStream.range(0, 1000)
                .mapToDouble(seed -> {
                    World world = World.create(spec, WorldSettings.defaults().withSeed(seed));
                    world.command(0, 1, 0);
                    return Specs.first(world.advance()).odometry().pose().x() / 0.1 - 1;
                })
                .toArray();
        assertThat(Arrays.stream(errors).boxed()).allMatch(error -> Math.abs(error) <= 0.05 + 1e-9);
        assertThat(mean(errors)).isCloseTo(0, within(0.005));
        assertThat(variance(errors)).isCloseTo(0.05 * 0.05 / 3, within(0.0001));
    }
}
