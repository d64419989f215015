package io.troupe.sim.learn;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.sim.Specs;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.WorldSpec;
import io.troupe.sim.worldfile.RandomWorld;
import java.io.ByteArrayInputStream;
import java.io.ByteArrayOutputStream;
import java.io.DataOutputStream;
import java.io.EOFException;
import java.io.IOException;
import java.io.InputStream;
import java.io.OutputStream;
import java.nio.ByteBuffer;
import java.nio.charset.StandardCharsets;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.Random;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

class TrialServerTest {
    private static final int WORLDS = 4;
    private static final int SONARS = 16;

    private static WorldSpec twoRobots(long seed) {
        return RandomWorld.arena(seed, 8, 0.1).withRobots(2);
    }

    // ---- frames, written and read by hand

    private final ByteArrayOutputStream requests = new ByteArrayOutputStream();
    private final DataOutputStream writer = new DataOutputStream(requests);

    private void request(byte[] body) throws IOException {
        writer.writeInt(body.length);
        writer.write(body);
    }

    private static byte[] resets(long... seeds) {
        ByteBuffer body = ByteBuffer.allocate(9 * seeds.length);
        for (long seed : seeds) {
            body.put((byte) 2).putLong(seed);
        }
        return body.array();
    }

    private List<ByteBuffer> answers(TrialServer server) throws IOException {
        var out = new ByteArrayOutputStream();
        server.serve(new ByteArrayInputStream(requests.toByteArray()), out);
        List<ByteBuffer> answers = new ArrayList<>();
        ByteBuffer all = ByteBuffer.wrap(out.toByteArray());
        while (all.hasRemaining()) {
            int length = all.getInt();
            answers.add(all.slice(all.position(), length));
            all.position(all.position() + length);
        }
        return answers;
    }

    private static String text(ByteBuffer frame) {
        return StandardCharsets.UTF_8.decode(frame.duplicate()).toString();
    }

    private static String refusal(ByteBuffer answer) {
        assertThat(answer.get(0)).isEqualTo((byte) 1);
        return text(answer.slice(1, answer.limit() - 1));
    }

    private static void assertIs(ByteBuffer answer, Observation expected) {
        assertThat(answer.getDouble()).isEqualTo(expected.timeS());
        for (int robot = 0; robot < 2; robot++) {
            assertThat(answer.getDouble()).isEqualTo(expected.x(robot));
            assertThat(answer.getDouble()).isEqualTo(expected.y(robot));
            assertThat(answer.getDouble()).isEqualTo(expected.headingRad(robot));
            assertThat(answer.getDouble()).isEqualTo(expected.stalled(robot) ? 1 : 0);
            assertThat(answer.getDouble()).isEqualTo(expected.collided(robot) ? 1 : 0);
            for (int sonar = 0; sonar < SONARS; sonar++) {
                assertThat(answer.getDouble()).isEqualTo(expected.rangeM(robot, sonar));
            }
        }
    }

    // ---- tests

    @Test
    void sample_saysWhatItHas() throws IOException {
        InputStream in = InputStream.nullInputStream();
        var bytes = new ByteArrayOutputStream();
        OutputStream out = bytes;
        try (var server =
                TrialServer.of(4, seed -> RandomWorld.arena(seed, 8, 0.1).withRobots(1))) {
            server.serve(in, out);
        }
        assertThat(bytes.toString(StandardCharsets.UTF_8).substring(4))
                .isEqualTo("{\"protocol\":1,\"worlds\":4,\"robots\":1,\"sonars\":16,\"greatestRangeM\":5.0,"
                        + "\"intervalS\":0.1}");
    }

    /** Random requests, in which each world is left alone, stepped or reset, on one thread and on several. */
    @ParameterizedTest
    @ValueSource(ints = {1, 3})
    void observations_areThoseOfTrials_bitForBit(int threads) throws IOException {
        long seed = 20;
        var random = new Random(seed);
        List<Trial> trials = new ArrayList<>();
        List<Observation> expected = new ArrayList<>();
        List<Integer> asked = new ArrayList<>();
        request(resets(0, 1, 2, 3));
        for (int world = 0; world < WORLDS; world++) {
            trials.add(Trial.of(TrialServerTest::twoRobots));
            expected.add(trials.get(world).reset(world));
        }
        asked.add(WORLDS);
        for (int round = 0; round < 60; round++) {
            ByteBuffer body = ByteBuffer.allocate(33 * WORLDS);
            int before = expected.size();
            for (Trial trial : trials) {
                int kind = random.nextInt(20) == 0 ? 2 : random.nextInt(4) == 0 ? 0 : 1;
                body.put((byte) kind);
                if (kind == 1) {
                    double[] actions = random.doubles(4, -0.6, 0.6).toArray();
                    for (double action : actions) {
                        body.putDouble(action);
                    }
                    expected.add(trial.step(actions));
                } else if (kind == 2) {
                    long newSeed = random.nextLong(1000);
                    body.putLong(newSeed);
                    expected.add(trial.reset(newSeed));
                }
            }
            request(Arrays.copyOf(body.array(), body.position()));
            asked.add(expected.size() - before);
        }

        List<ByteBuffer> answers;
        try (var server = TrialServer.of(WORLDS, TrialServerTest::twoRobots, WorldSettings.defaults(), threads)) {
            answers = answers(server);
        }

        assertThat(answers).hasSize(1 + asked.size());
        int next = 0;
        for (int i = 0; i < asked.size(); i++) {
            ByteBuffer answer = answers.get(i + 1);
            assertThat(answer.get()).as("request %d of seed %d", i, seed).isZero();
            for (int world = 0; world < asked.get(i); world++) {
                assertIs(answer, expected.get(next++));
            }
            assertThat(answer.hasRemaining()).isFalse();
        }
    }

    @Test
    void wrongRequests_areRefused_andChangeNothing() throws IOException {
        byte[] step = ByteBuffer.allocate(34).put((byte) 1).array(); // all speeds are zero
        request(step);
        request(resets(7, 8));
        request(new byte[] {3, 0});
        request(new byte[] {0, 1, 5});
        request(new byte[] {0, 0, 0});
        ByteBuffer notFinite = ByteBuffer.allocate(66);
        notFinite.put((byte) 1).putDouble(0).putDouble(0).putDouble(0).putDouble(0);
        notFinite.put((byte) 1).putDouble(0.2).putDouble(Double.NaN);
        request(notFinite.array());
        request(step);
        List<ByteBuffer> answers;
        try (var server = TrialServer.of(2, TrialServerTest::twoRobots)) {
            answers = answers(server);
        }
        assertThat(refusal(answers.get(1))).isEqualTo("world 0: a step before the first reset");
        assertThat(refusal(answers.get(3))).isEqualTo("world 0: kind 3, expected 0 (leave), 1 (step) or 2 (reset)");
        assertThat(refusal(answers.get(4))).isEqualTo("the request ends after 3 bytes, expected more for world 1");
        assertThat(refusal(answers.get(5))).isEqualTo("1 bytes after the last world, expected none");
        assertThat(refusal(answers.get(6))).isEqualTo("world 1: an action of NaN, expected finite numbers");
        assertThat(answers.get(7).get()).isZero();
        assertThat(answers.get(7).getDouble()).as("only one step was made").isEqualTo(0.1);
    }

    /** Cut-off and arbitrary requests are refused or make steps; a frame that is too long ends the conversation. */
    @Test
    void arbitraryRequests_areAnsweredInOrder() throws IOException {
        long seed = 5;
        var random = new Random(seed);
        for (int i = 0; i < 500; i++) {
            var body = new byte[random.nextInt(18)];
            random.nextBytes(body);
            if (body.length > 0) {
                body[0] = (byte) random.nextInt(4);
            }
            request(body);
        }
        try (var server =
                TrialServer.of(1, seed2 -> RandomWorld.arena(seed2, 8, 0).withRobots(1))) {
            assertThat(answers(server)).as("seed %d", seed).hasSize(501);
            requests.reset();
            writer.writeInt(18);
            assertThatThrownBy(() -> answers(server))
                    .isInstanceOf(IOException.class)
                    .hasMessage("a request of 18 bytes, expected at most 17 for 1 worlds");
            requests.reset();
            writer.writeInt(17);
            writer.write(1);
            assertThatThrownBy(() -> answers(server)).isInstanceOf(EOFException.class);
        }
    }

    @Test
    void worldThatCannotBeBuilt_isRefused_untilItIsReset() throws IOException {
        request(resets(3));
        request(new byte[] {1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
        request(resets(1));
        try (var server = TrialServer.of(
                1, seed -> RandomWorld.arena(seed, seed == 3 ? 1 : 8, 0).withRobots(1))) {
            List<ByteBuffer> answers = answers(server);
            assertThat(refusal(answers.get(1))).startsWith("a random arena is 1.0 m by 1.0 m");
            assertThat(refusal(answers.get(2))).isEqualTo("world 0: a step before the first reset");
            assertThat(answers.get(3).get()).isZero();
        }
    }

    @Test
    void worldsWithoutSonars_areRefused() {
        WorldSpec blind = Specs.world(Specs.robot("r", Pose.ORIGIN, Specs.ORANGE, null, null));
        assertThatThrownBy(() -> TrialServer.of(1, seed -> blind))
                .hasMessage("robot 'r' has no sonars, or another number of them, expected as many for each robot");
        assertThatThrownBy(() -> TrialServer.of(0, seed -> blind)).hasMessage("0 worlds, expected at least 1");
    }
}
