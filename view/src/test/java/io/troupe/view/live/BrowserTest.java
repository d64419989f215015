package io.troupe.view.live;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;
import static org.junit.jupiter.api.Assumptions.assumeTrue;

import io.troupe.actor.ActorSettings;
import io.troupe.actor.ActorSpace;
import io.troupe.actor.CallGraph;
import io.troupe.actor.SpaceSettings;
import io.troupe.player.PlayerClient;
import io.troupe.player.structures.PlayerConstants;
import io.troupe.services.subsumption.Mode;
import io.troupe.sim.Pace;
import io.troupe.sim.Simulation;
import io.troupe.sim.SimulationRunner;
import io.troupe.sim.Snapshot;
import io.troupe.sim.World;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.device.DeviceReading;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.WorldSpec;
import io.troupe.sim.worldfile.CrowdWorld;
import io.troupe.sim.worldfile.ScenarioReader;
import io.troupe.view.DeviceRoom;
import io.troupe.view.Pictures;
import io.troupe.view.PushedBox;
import io.troupe.view.RecordedRun;
import io.troupe.view.RunRecorder;
import java.awt.image.BufferedImage;
import java.io.IOException;
import java.net.BindException;
import java.net.InetAddress;
import java.net.ServerSocket;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.concurrent.CountDownLatch;
import java.util.regex.Pattern;
import javax.imageio.ImageIO;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.AfterAll;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.api.parallel.Execution;
import org.junit.jupiter.api.parallel.ExecutionMode;
import org.junit.jupiter.api.parallel.ResourceLock;
import org.junit.jupiter.api.parallel.ResourceLockTarget;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.EnumSource;

/**
 * The page in Chromium; skipped where there is none. With {@code -Dpictures=DIR} it writes the pictures of the guide.
 */
@Timeout(600)
@Execution(ExecutionMode.CONCURRENT)
@ResourceLock(value = "the browser", target = ResourceLockTarget.CHILDREN)
class BrowserTest {
    private static final char ARROW_UP = '\uE013';
    private static final char ESCAPE = '\uE00C';
    private static final char DELETE = '\uE017';

    private static @Nullable Browser browser;

    @TempDir
    private Path folder;

    @BeforeAll
    static void open() throws IOException {
        assumeTrue(Browser.isInstalled(), "chromium and chromedriver are not installed: the live page is not tested");
        browser = Browser.open();
    }

    @AfterAll
    static void close() {
        if (browser != null) {
            browser.close();
        }
    }

    @BeforeEach
    void leaveThePageOfTheTestBefore() {
        page().open("about:blank");
        page().console();
    }

    /** The browser itself reports each request that a server which has been closed does not answer. */
    @AfterEach
    void consoleHasNoErrors() {
        String console = page().console().replaceAll("\\{[^{}]*(ERR_CONNECTION|ERR_INCOMPLETE|ERR_EMPTY)[^{}]*}", "");
        assertThat(console).doesNotContain("SEVERE", "WARNING");
    }

    private static Browser page() {
        if (browser == null) {
            throw new IllegalStateException("no browser");
        }
        return browser;
    }

    private LiveRuns.Endless run(double speed) throws IOException {
        return new LiveRuns.Endless(folder.resolve("run.jsonl"), 0, speed);
    }

    private static void open(LiveView of) {
        page().size(1280, 800);
        page().open(of.address());
        page().await("troupe.model.frame !== null && troupe.source.viewer !== undefined");
    }

    private static void picture(String name) throws IOException {
        String pictures = System.getProperty("pictures");
        if (pictures != null) {
            page().await("(window.drawn ??= troupe.view.drawn) + 20 < troupe.view.drawn");
            Files.write(Path.of(pictures, name), page().screenshot());
        }
    }

    @Test
    void page_showsTwoMovingRobots_withNamesServicesAndRaysThatEndAtWalls() throws Exception {
        try (var run = run(5)) {
            open(run.page);
            page().await("document.querySelectorAll('#robots button').length === 2");
            assertThat(page().get("document.querySelector('#robots').textContent"))
                    .contains("robot1", "robot2");
            page().await("document.querySelector('#robots').textContent.includes('wallFollower')");
            String start = page().get("troupe.model.frame.x[0] + ' ' + troupe.model.frame.y[0]");
            page().await("Math.hypot(troupe.model.frame.x[0] - " + start.replace(" ", ", troupe.model.frame.y[0] - ")
                    + ") > 0.3");
            page().await("troupe.model.trails[0].length > 60 && troupe.model.readings.size === 2");
            run.control.submit(new ViewCommand.Pause());
            page().await("troupe.paused && document.querySelector('#play').textContent === 'Go on'");
            page().await("troupe.view.sonarEnds(troupe.model.frame, 0).some(ray => ray.hit)");
            assertThat(page().get("troupe.view.sonarEnds(troupe.model.frame, 0).filter(ray => ray.hit)"
                            + ".every(ray => Math.abs(ray.to[0]) < 6.05 && Math.abs(ray.to[1]) < 4.55)"))
                    .as("hits are inside of the outer walls, whose faces are 6 m and 4.5 m from the middle")
                    .isEqualTo("true");
            picture("watching-arena.png");
        }
    }

    @Test
    void pauseStopsTime_aStepIsOneInterval_andSpeedIsChosen() throws Exception {
        try (var run = run(1)) {
            open(run.page);
            page().get("document.querySelector('#play').click()");
            page().await("troupe.paused");
            assertThat(run.control.isPaused()).isTrue();
            page().await("(window.still = troupe.model.frame.number === window.last ? (window.still ?? 0) + 1 : 0,"
                    + " window.last = troupe.model.frame.number, window.still) > 20");
            double before = page().number("troupe.model.frame.time");
            page().get("document.querySelector('#step').click()");
            page().await("troupe.model.frame.time > " + before);
            assertThat(page().number("troupe.model.frame.time")).isCloseTo(before + 0.1, within(1e-9));
            page().get("(document.querySelector('#speed').value = '5',"
                    + " document.querySelector('#speed').dispatchEvent(new Event('change')))");
            page().get("document.querySelector('#play').click()");
            page().await("!troupe.paused");
            assertThat(run.control.speed()).isEqualTo(5);
        }
    }

    @Test
    void draggedRobot_isWhereItWasDropped_onTheServerToo_andIsTurnedByItsRing() throws Exception {
        try (var run = run(1)) {
            open(run.page);
            run.control.submit(new ViewCommand.Pause());
            page().await("troupe.paused");
            drag("[troupe.model.frame.x[0], troupe.model.frame.y[0]]", "[3.5, 1]");
            page().await("document.querySelector('#problem').hidden");
            assertThat(page().get("troupe.view.dropped.map(each => each.robot + ' ' + Math.round(2 * each.x)).join()"))
                    .as("what is shown until the next interval")
                    .isEqualTo("0 7");
            run.control.submit(new ViewCommand.Step());
            page().await("troupe.view.dropped.length === 0");
            page().await("Math.hypot(troupe.model.frame.x[0] - 3.5, troupe.model.frame.y[0] - 1) < 0.1");
            drag("troupe.view.handle(troupe.model.frame, 0)", "[3.5, 3]");
            run.control.submit(new ViewCommand.Step());
            page().await("Math.abs(troupe.model.frame.heading[0] - Math.PI / 2) < 0.2");
            page().await("document.querySelectorAll('#events li[data-kind=intervention]').length > 0");
            assertThat(page().get("document.querySelector('#events li[data-kind=intervention] span').textContent"))
                    .as("the newest event; one line for all the places of a drag")
                    .matches("by hand: robot1 put to 3\\.\\d\\d m, [01]\\.\\d\\d m");
            assertThat(page().get("document.querySelectorAll('#events li[data-kind=intervention]').length"))
                    .isEqualTo("1");
        }
        List<String> lines = Files.readAllLines(folder.resolve("run.jsonl"));
        assertThat(lines).anyMatch(line -> line.contains("\"what\":\"place 1 3."));
        double nearestM = lines.stream()
                .filter(line -> line.contains("\"type\":\"pose\",\"robot\":1,"))
                .mapToDouble(line -> Math.hypot(number(line, "x") - 3.5, number(line, "y") - 1))
                .min()
                .orElseThrow();
        assertThat(nearestM)
                .as("from where it was dropped, in the log of the run")
                .isLessThan(0.1);
    }

    @Test
    void coloured_box_isPutByAClick_movedByDragging_seenByTheRobot_andRemovedByDelete() throws Exception {
        try (var run = run(1)) {
            open(run.page);
            run.control.submit(new ViewCommand.Place(0, new Pose(-3, 0, 0)));
            run.control.submit(new ViewCommand.Pause());
            page().await("troupe.paused");
            page().get("(document.querySelector('#box-colour').value = '00ff00')");
            page().press('b');
            page().await("document.querySelector('#box').getAttribute('aria-pressed') === 'true'");
            int[] spot = point("[-1, 1]");
            page().drag(List.of(spot, spot));
            page().await("document.querySelector('#box').getAttribute('aria-pressed') === 'false'");
            step(run);
            page().await("troupe.model.boxes.length === 1");
            assertThat(page().get("JSON.stringify(troupe.model.boxes[0].colour)"))
                    .isEqualTo("65280");
            drag("[troupe.model.boxes[0].x, troupe.model.boxes[0].y]", "[-1, 0]");
            step(run);
            page().await("troupe.model.boxes.length === 1 && Math.abs(troupe.model.boxes[0].y) < 0.1");
            page().await("troupe.model.readings.get(0)?.blobs.some(blob => blob.colour === 0x00ff00)");
            picture("watching-box.png");
            drag("[troupe.model.boxes[0].x, troupe.model.boxes[0].y]", "[-3, 0]");
            step(run);
            page().await("document.querySelector('#problem').textContent.includes('overlap')");
            assertThat(page().get("Math.abs(troupe.model.boxes[0].x + 1) < 0.1"))
                    .as("it has stayed where it was")
                    .isEqualTo("true");
            page().press(DELETE);
            step(run);
            page().await("troupe.model.boxes.length === 0");
        }
        assertThat(folder.resolve("run.jsonl")).content().contains("\"what\":\"box 1 00ff00 ", "\"what\":\"unbox 1\"");
    }

    /** One interval passes, after what the page has sent. */
    private static void step(LiveRuns.Endless run) {
        page().get("(window.sent = false, troupe.source.queue.then(() => { window.sent = true; }))");
        page().await("window.sent");
        run.control.submit(new ViewCommand.Step());
    }

    private static double number(String line, String key) {
        var found = Pattern.compile("\"" + key + "\":([-0-9.E]+)").matcher(line);
        assertThat(found.find()).isTrue();
        return Double.parseDouble(found.group(1));
    }

    /** Drags from one place of the world to another, given as expressions of the page. */
    private static void drag(String from, String to) {
        page().drag(List.of(point(from), point("[(" + from + ")[0] + 0.5, (" + from + ")[1]]"), point(to), point(to)));
    }

    private static int[] point(String place) {
        String box = "document.querySelector('#world').getBoundingClientRect()";
        String[] point = page().get("troupe.view.toPage(...(" + place + ")).map((each, i) => Math.round(each + (i ? "
                        + box + ".top : " + box + ".left))).join(' ')")
                .split(" ");
        return new int[] {Integer.parseInt(point[0]), Integer.parseInt(point[1])};
    }

    @Test
    void arrowKeys_driveTheSelectedRobot_untilTheyAreReleased() throws Exception {
        try (var run = run(1)) {
            open(run.page);
            run.control.submit(new ViewCommand.Place(0, new Pose(-4, -1, 0)));
            page().get("troupe.select(0)");
            page().key("keyDown", ARROW_UP);
            page().await("(troupe.model.frame.state[0] & Model.BY_HAND) !== 0");
            page().await("troupe.model.readings.get(0)?.forward === 0.4");
            page().key("keyUp", ARROW_UP);
            page().await("(troupe.model.frame.state[0] & Model.BY_HAND) === 0");
            page().await("troupe.model.readings.get(0)?.forward < 0.4");
        }
        assertThat(folder.resolve("run.jsonl"))
                .content()
                .contains("\"what\":\"drive 1 0.4 0.0\"", "\"what\":\"release 1\"");
    }

    @ParameterizedTest
    @EnumSource(
            value = Mode.class,
            names = {"CALLBACK", "PROMISE"})
    void actors_areAGraphOfWhoCallsWhom_withRatesAndMailboxes(Mode mode) throws Exception {
        try (var run = new LiveRuns.Endless(folder.resolve("run.jsonl"), 0, 20, mode)) {
            open(run.page);
            page().await("!document.querySelector('#actors-shown').hidden");
            page().press('a');
            page().await("document.querySelectorAll('#calls g').length >= 4");
            page().await("document.querySelector('#calls').textContent.includes('Arbitrator')");
            String receiver = mode == Mode.CALLBACK ? "'Arbitrator (results)'" : "'robots/robotServices'";
            page().await("troupe.actors.before !== null && [...document.querySelectorAll('#call-figures tbody tr')]"
                    + ".some(row => row.children[1].textContent === " + receiver
                    + " && Number(row.children[2].textContent) > 0)");
            assertThat(
                            page().get(
                                            "[...document.querySelectorAll('#calls g')].every(box => / waiting/.test(box.textContent))"))
                    .isEqualTo("true");
            var graph = run.page.callGraph().snapshot();
            assertThat(graph.nodes()).extracting(CallGraph.Node::name).contains("Arbitrator", "robots/robotServices");
            assertThat(graph.edges().stream()
                            .filter(each -> each.to().name().equals("Arbitrator"))
                            .anyMatch(each -> each.results() > 0))
                    .as("colours that were sent one after the other")
                    .isEqualTo(mode == Mode.CALLBACK);
            if (mode == Mode.CALLBACK) {
                picture("watching-actors.png");
            }
            page().press('a');
            page().await("document.querySelector('#actors').hidden");
        }
    }

    @Test
    void actorsWithSimilarNames_haveDifferentLabels_andThoseOfABusNoTurns() throws Exception {
        String twice = "a rather long name that is the same until its end, for number ";
        try (var view = LiveView.open(LiveView.Settings.defaults().withPort(0))) {
            new ViewedRun(LiveRuns.ARENA.world(), LiveRuns.TABLE, new RunControl(0, false))
                    .onto(view)
                    .moved(LiveRuns.start());
            view.callGraph().note("robots", "Arbitrator", twice + 1);
            view.callGraph().note("bus", "arbitrator", "host-a");
            view.callGraph().note("robots", "Arbitrator", twice + 2);
            open(view);
            page().await("!document.querySelector('#actors-shown').hidden");
            page().get("document.querySelector('#actors-shown').click()");
            page().await("document.querySelectorAll('#calls g').length === 5");
            String boxes = page().get(
                            "[...document.querySelectorAll('#calls g')]"
                                    + ".map(box => [...box.querySelectorAll('text')].map(each => each.textContent).join(' ')).join('|')");
            assertThat(boxes.split("\\|"))
                    .doesNotHaveDuplicates()
                    .contains("Arbitrator (robots) 0/s, 0 waiting", "arbitrator (bus) on the bus", "host-a on the bus");
            assertThat(
                            page().get(
                                            "[...document.querySelectorAll('#calls g')].every(box => { const frame ="
                                                    + " box.querySelector('rect').getBBox(); return [...box.querySelectorAll('text')].every(each =>"
                                                    + " each.getBBox().width < frame.width && each.getBBox().y + each.getBBox().height < frame.height); })"))
                    .as("all text is inside of its box")
                    .isEqualTo("true");
        }
    }

    @Test
    void actorThatIsStuckInATurn_isMarked_withItsMailbox() throws Exception {
        var release = new CountDownLatch(1);
        try (var view = LiveView.open(LiveView.Settings.defaults().withPort(0));
                var space = ActorSpace.create(SpaceSettings.named("stuck").withCallObserver(view.callGraph()))) {
            new ViewedRun(LiveRuns.ARENA.world(), LiveRuns.TABLE, new RunControl(0, false))
                    .onto(view)
                    .moved(LiveRuns.start());
            Sleeper sleeper = space.spawn(
                    Sleeper.class, () -> () -> awaitUninterruptibly(release), ActorSettings.named("sleeper"));
            for (int i = 0; i < 4; i++) {
                sleeper.sleep();
            }
            try {
                open(view);
                page().await("!document.querySelector('#actors-shown').hidden");
                page().get("document.querySelector('#actors-shown').click()");
                page().await("document.querySelector('#calls g.alarm')?.dataset.name === 'sleeper'");
                assertThat(page().get("document.querySelector('#calls g.alarm').textContent"))
                        .contains("3 waiting", "s in one turn");
                assertThat(page().get("document.querySelector('#actor-figures tr.alarm').textContent"))
                        .startsWith("sleeper");
            } finally {
                release.countDown();
            }
            page().await("document.querySelector('#calls g.alarm') === null");
        }
    }

    interface Sleeper {
        void sleep();
    }

    private static void awaitUninterruptibly(CountDownLatch latch) {
        try {
            latch.await();
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
    }

    @Test
    void timeLine_listsTheSwitchesOfTheLog() throws Exception {
        Path log = folder.resolve("short.jsonl");
        try (var view = LiveView.open(LiveView.Settings.defaults().withPort(0))) {
            var viewed = new ViewedRun(LiveRuns.ARENA.world(), LiveRuns.TABLE, new RunControl(0, true)).onto(view);
            LiveRuns.run(log, 300, viewed.listener(RecordedRun.Listener.NONE));
            open(view);
            List<String> switches = Files.readAllLines(log).stream()
                    .filter(line -> line.contains("\"type\":\"state\""))
                    .map(line -> number(line, "t") + " " + (int) number(line, "state"))
                    .toList();
            assertThat(switches).hasSizeGreaterThan(5);
            page().await("document.querySelectorAll('#events li[data-kind=state]').length === " + switches.size());
            assertThat(page().get("[...document.querySelectorAll('#events li[data-kind=state]')].reverse()"
                            + ".map(each => Number(each.dataset.time).toFixed(1) + ' '"
                            + " + /state (\\d+)/.exec(each.textContent)[1]).join('|')"))
                    .isEqualTo(String.join("|", switches));
        }
    }

    /** A free port below those that systems give to outgoing connections: one may get a port that was closed. */
    private static int portThatNoConnectionTakes() throws IOException {
        for (int port = 10_000 + (int) (ProcessHandle.current().pid() % 10_000); port < 32_768; port++) {
            try (var free = new ServerSocket(port, 1, InetAddress.getLoopbackAddress())) {
                return free.getLocalPort();
            } catch (BindException taken) {
                // the next one
            }
        }
        throw new IllegalStateException("no free port below 32768");
    }

    @Test
    void page_reconnects_afterTheServerHasStartedAgain() throws Exception {
        int port = portThatNoConnectionTakes();
        try (var run = new LiveRuns.Endless(folder.resolve("run.jsonl"), port, 1)) {
            open(run.page);
            page().await("document.querySelector('#status').textContent === 'live'");
        }
        page().await("document.querySelector('#status').textContent.includes('trying again')");
        try (var again = new LiveRuns.Endless(folder.resolve("again.jsonl"), port, 1)) {
            page().await("document.querySelector('#status').textContent === 'live' && troupe.model.frame.time < 100");
            assertThat(again.page.viewers()).isEqualTo(1);
        }
        page().await("document.querySelector('#status').textContent.includes('trying again')");
    }

    @Test
    void thousandRobots_areDrawn() throws Exception {
        var scenario = LiveRuns.atOwnPort(CrowdWorld.scenario(1000, 8));
        try (var simulation = Simulation.open(scenario, WorldSettings.defaults());
                var view = LiveView.open(LiveView.Settings.defaults().withPort(0))) {
            var viewed = new ViewedRun(scenario.world(), new RunControl(0, false)).onto(view);
            viewed.moved(simulation.latest());
            open(view);
            page().await("troupe.model.frame.count === 1000 && troupe.view.drawn > 5");
            assertThat(page().get("troupe.model.frame.x.every(Number.isFinite)"))
                    .isEqualTo("true");
            assertThat(page().get("document.body.classList.contains('many')")).isEqualTo("true");
            assertThat(page().get("document.querySelector('#unlisted').textContent"))
                    .isEqualTo("200 of 1000 robots are listed; find others by their names");
            for (int i = 0; i < 1000; i++) {
                simulation.world().command(i, 0.3, 0.2);
            }
            for (int i = 0; i < 20; i++) {
                viewed.moved(simulation.tick());
            }
            page().await("troupe.model.frame.time >= 2");
            page().get("troupe.select(30)");
            page().await("troupe.model.readings.has(30)");
            picture("watching-crowd.png");
        }
    }

    @Test
    void file_playsScrubsAndJumpsToASwitch_withoutAServer() throws Exception {
        Path html = folder.resolve("run.html");
        var file = new ViewFile();
        var viewed = new ViewedRun(LiveRuns.ARENA.world(), LiveRuns.TABLE, new RunControl(0, false)).onto(file);
        LiveRuns.run(folder.resolve("run.jsonl"), 300, viewed.listener(RecordedRun.Listener.NONE));
        Files.writeString(html, file.html());
        page().size(1280, 800);
        page().open(html.toUri().toString());
        page().await("troupe.source.frames.length === 3001");
        assertThat(page().number("troupe.source.end()")).isEqualTo(300);
        page().get("document.querySelector('#play').click()");
        page().await("troupe.source.now > 0.3");
        page().get("document.querySelector('#play').click()");
        page().await("document.querySelectorAll('#events li[data-kind=state] button').length > 5");
        page().get("[...document.querySelectorAll('#events li[data-kind=state] button')].at(-2).click()");
        double at = page().number(
                        "Number([...document.querySelectorAll('#events li[data-kind=state]')].at(-2).dataset.time)");
        assertThat(page().number("troupe.source.now")).isEqualTo(at);
        page().await("troupe.model.frame.time > " + (at - 0.11) + " && troupe.model.frame.time <= " + (at + 1e-9));
        scrubTo(120);
        page().get("troupe.chooseTheme(true)");
        picture("watching-file.png");

        page().get("troupe.chooseTheme(false)");
        var robots = "document.querySelector('#robots').textContent.replace(/\\s/g, '')";
        for (String moment : List.of(
                "80 1 robot1wallFollower.*robot2spaceWanderer",
                "128 2 robot1spaceWanderer.*robot2wallFollower",
                "104 3 robot1spaceWanderer.*robot2spaceWanderer")) {
            String[] timeStateServices = moment.split(" ");
            scrubTo(Integer.parseInt(timeStateServices[0]));
            page().await("/" + timeStateServices[2] + "/.test(" + robots + ")");
            picture("paper-state-" + timeStateServices[1] + ".png"); // as Figures 9 to 11 of the paper
        }
    }

    @Test
    void pageBesideAWorld_keepsTheNewestEvents_andAFileKnowsWhoDroveAtEachTime() throws Exception {
        try (var view = LiveView.open(LiveView.Settings.defaults().withPort(0))) {
            var viewed = new ViewedRun(LiveRuns.ARENA.world(), LiveRuns.TABLE, new RunControl(0, false)).onto(view);
            viewed.moved(World.create(LiveRuns.ARENA.world(), WorldSettings.defaults())
                    .latest());
            open(view);
            page().await("troupe.model.frame !== null");
            page().get(
                            "troupe.model.addEvents(Array.from({length: 30000}, (_, i) => ({t: i / 10, kind: 'contact', robot: 1})))");
            page().await("document.querySelector('#events li')?.dataset.time === '2999.9'");
            assertThat(page().number("troupe.model.events.length")).isBetween(17_000.0, 20_000.0);
            page().get("troupe.model.addEvents([{t: 3001, kind: 'contact', robot: 2}])");
            page().await("document.querySelector('#events li').dataset.time === '3001'");
        }
        Path html = folder.resolve("run.html");
        var file = new ViewFile();
        var viewed = new ViewedRun(LiveRuns.ARENA.world(), LiveRuns.TABLE, new RunControl(0, false)).onto(file);
        LiveRuns.run(folder.resolve("run.jsonl"), 12, viewed.listener(RecordedRun.Listener.NONE));
        Files.writeString(html, file.html());
        page().open(html.toUri().toString());
        page().await("troupe.source.frames.length === 121");
        page().get("troupe.model.addEvents([{t: 4, kind: 'driver', robot: 1, node: 'early'},"
                + " {t: 8, kind: 'driver', robot: 1, node: 'late'}])");
        var first = "document.querySelector('#robots button').lastChild.textContent";
        scrubTo(5);
        page().await(first + ".endsWith(', early')");
        scrubTo(9);
        page().await(first + ".endsWith(', late')");
        scrubTo(1);
        page().await("!" + first + ".includes(',')");
    }

    private static void scrubTo(int seconds) {
        page().get("(document.querySelector('#scrub').value = " + seconds
                + ", document.querySelector('#scrub').dispatchEvent(new Event('input')))");
        page().await("document.querySelector('#clock').textContent === '" + seconds + ".0 s'");
    }

    /** Of a run with switches, in which a robot waits and is put elsewhere, and in which the world is reset. */
    @Test
    void trails_areWhereRobotsDrove_withoutLinesToWhereTheyWerePut() throws Exception {
        Path html = folder.resolve("trails.html");
        var control = new RunControl(0, true);
        var file = new ViewFile();
        Map<Long, ViewCommand> commands = Map.of(
                60_000_000L, new ViewCommand.Drive(0, 0, 0),
                62_000_000L, new ViewCommand.Place(0, new Pose(4, -3, 0)),
                62_100_000L, new ViewCommand.Release(0),
                150_000_000L, new ViewCommand.Reset());
        try (var view = LiveView.open(LiveView.Settings.defaults().withPort(0))) {
            var viewed = new ViewedRun(LiveRuns.ARENA.world(), LiveRuns.TABLE, control)
                    .onto(view)
                    .onto(file);
            LiveRuns.run(folder.resolve("run.jsonl"), 300, viewed.listener(new RecordedRun.Listener() {
                @Override
                public void recorded(Snapshot snapshot, RunRecorder recorder) {
                    ViewCommand command = commands.get(snapshot.timeMicros());
                    if (command != null) {
                        control.submit(command);
                    }
                }
            }));
            Files.writeString(html, file.html());
            open(view);
            page().await("troupe.model.frame.time === 300");
            assertThat(longestLineM())
                    .as("of a viewer that comes at the end, who gets two frames a second")
                    .isLessThan(0.3);
        }
        page().open(html.toUri().toString());
        page().await("troupe.source.frames.length === 3001");
        assertThat(longestLineM()).isLessThan(0.1);
        assertThat(page().get("new Set(troupe.model.trails.flat().map(point => point?.service)).size"))
                .as("two services, and the gaps")
                .isEqualTo("3");
        assertThat(page().get("troupe.model.trails.map(trail => trail.filter(point => point === null).length)"))
                .as("gaps: one robot was put elsewhere twice, the other once")
                .isEqualTo("2,1");
    }

    @Test
    void trails_haveGapsWhereClientsPutRobots_whereTheyWereAway_andWhereTimeIsMissing() throws Exception {
        try (var world = World.create(LiveRuns.ARENA.world(), WorldSettings.defaults());
                var view = LiveView.open(LiveView.Settings.defaults().withPort(0))) {
            var viewed = new ViewedRun(LiveRuns.ARENA.world(), new RunControl(0, false)).onto(view);
            viewed.moved(world.latest());
            open(view);
            world.command(0, 0.3, 0);
            advance(world, viewed, 10);
            assertThat(trailGaps()).isZero();
            world.teleport(0, new Pose(3, 1, 0));
            advance(world, viewed, 5);
            assertThat(trailGaps()).as("put elsewhere by a client").isEqualTo(1);
            world.removeRobot(0);
            advance(world, viewed, 2);
            world.teleport(0, new Pose(-3, 1, 0));
            advance(world, viewed, 2);
            assertThat(trailGaps()).as("away").isEqualTo(2);
            world.command(0, 0.3, 0);
            for (int i = 0; i < 30; i++) {
                world.advance(); // faster than frames are shown
            }
            advance(world, viewed, 2);
            assertThat(trailGaps()).as("three seconds are not known").isEqualTo(3);
            assertThat(
                            page().get(
                                            "[...troupe.view.trailsUntil(Infinity).keys()].map(each => troupe.view.colourOf(each)).join()"))
                    .as("the robot's colour, as there are no services")
                    .isEqualTo("#ffa500");
        }
    }

    private static void advance(World world, ViewedRun viewed, int ticks) {
        for (int i = 0; i < ticks; i++) {
            viewed.moved(world.advance());
        }
        page().await("troupe.model.frame.time === " + world.latest().timeMicros() / 1e6);
    }

    /** Gaps in the trail of the first robot. */
    private static int trailGaps() {
        return (int) page().number("troupe.model.trails[0].filter(each => each === null).length");
    }

    /** Length of the longest straight line of the trails. */
    private static double longestLineM() {
        return page().number(
                        "(() => { const whole = Path2D; let longest = 0;"
                                + " window.Path2D = class { moveTo(...to) { this.at = to; }"
                                + " lineTo(...to) { longest = Math.max(longest, Math.hypot(to[0] - this.at[0], to[1] - this.at[1])); this.at = to; } };"
                                + " try { troupe.view.trailsUntil(Infinity); } finally { window.Path2D = whole; } return longest; })()");
    }

    @Test
    void pushedBox_isDrawnWhereItIs_onThePageAndInAFile() throws Exception {
        List<Snapshot> pushed = PushedBox.run();
        double endX = pushed.getLast().moved().getFirst().x();
        Path html = folder.resolve("push.html");
        var file = new ViewFile();
        try (var view = LiveView.open(LiveView.Settings.defaults().withPort(0))) {
            var viewed = new ViewedRun(PushedBox.WORLD, new RunControl(0, false))
                    .onto(view)
                    .onto(file);
            viewed.moved(pushed.getFirst());
            open(view);
            page().await(isRed(0.5));
            pushed.stream().skip(1).forEach(viewed::moved);
            page().await("Math.abs(troupe.model.frame.obstacles.get(0)?.x - " + endX + ") < 0.001");
            page().await(isRed(endX) + " && !" + isRed(0.5));
            Files.writeString(html, file.html());
        }
        page().open(html.toUri().toString());
        page().await("troupe.source.frames.length === 61");
        page().await(isRed(0.5));
        page().get("troupe.source.seek(6)");
        page().await(isRed(endX) + " && !" + isRed(0.5));
        page().get("troupe.source.seek(0)");
        page().await(isRed(0.5) + " && !" + isRed(endX));
    }

    /** Whether the box is drawn at a place. */
    private static String isRed(double x) {
        return "(([r, g, b]) => r > 200 && g < 50 && b < 50)(" + pixel("[" + x + ", 0.03]") + ")";
    }

    /** Red, green and blue of what is drawn at a place of the world. */
    private static String pixel(String place) {
        return pixel(
                "troupe.view.canvas", "troupe.view.toPage(..." + place + ").map(each => each * troupe.view.ratio)");
    }

    private static String pixel(String canvas, String at) {
        return "(([x, y]) => { const one = document.createElement('canvas');"
                + " const to = one.getContext('2d', {willReadFrequently: true});"
                + " to.drawImage(" + canvas + ", -Math.round(x), -Math.round(y));"
                + " return to.getImageData(0, 0, 1, 1).data; })(" + at + ")";
    }

    /** A cross of two walls, a corner, which is one body of two walls, and a ring with a bar across its right side. */
    private WorldSpec overlappingWalls() throws IOException {
        var ring = new BufferedImage(5, 5, BufferedImage.TYPE_INT_RGB);
        for (int pixel = 0; pixel < 25; pixel++) {
            boolean inside = pixel / 5 % 4 != 0 && pixel % 5 % 4 != 0;
            ring.setRGB(pixel % 5, pixel / 5, inside ? 0xffffff : 0);
        }
        ImageIO.write(ring, "png", folder.resolve("ring.png").toFile());
        return ScenarioReader.readText("""
                model ( name "across" color "black" pose [ -3 0 0 0 ] size [ 2 0.4 0.5 ] )
                model ( name "along" color "black" pose [ -3 0 0 0 ] size [ 0.4 2 0.5 ] )
                model ( name "corner" color "black" pose [ 0 0 0 0 ] size [ 3 3 0.5 ]
                  block ( points 4 point[0] [ 0 0 ] point[1] [ 6 0 ] point[2] [ 6 1 ] point[3] [ 0 1 ] )
                  block ( points 4 point[0] [ 0 0 ] point[1] [ 1 0 ] point[2] [ 1 6 ] point[3] [ 0 6 ] ) )
                model ( name "ring" color "black" bitmap "ring.png" pose [ 4 0 0 0 ] size [ 2.5 2.5 0.5 ] )
                model ( name "bar" color "black" pose [ 5 0 0 0 ] size [ 1 0.3 0.5 ] )
                """, folder.resolve("walls.world")).world();
    }

    @Test
    void wallsThatOverlap_areFilled_andHolesAreOpen_onThePageInAFileAndInAPicture() throws Exception {
        WorldSpec walls = overlappingWalls();
        Path html = folder.resolve("walls.html");
        Path svg = folder.resolve("walls.svg");
        var file = new ViewFile();
        try (var world = World.create(walls, WorldSettings.defaults());
                var view = LiveView.open(LiveView.Settings.defaults().withPort(0))) {
            var viewed =
                    new ViewedRun(walls, new RunControl(0, false)).onto(view).onto(file);
            viewed.moved(world.latest());
            open(view);
            assertWallsAreFilled();
            Files.writeString(html, file.html());
            Files.writeString(svg, Pictures.world(walls, world.latest()));
        }
        page().open(svg.toUri().toString());
        assertThat(isFilled("corner", 0.1)).as("the corner").isEqualTo("true");
        assertThat(isFilled("corner", 0.5)).as("between its walls").isEqualTo("false");
        assertThat(isFilled("ring", 0.1)).as("a corner of the ring").isEqualTo("true");
        assertThat(isFilled("ring", 0.5)).as("its hole").isEqualTo("false");
        page().open(html.toUri().toString());
        page().await("troupe.model.frame !== null");
        assertWallsAreFilled();
    }

    private static void assertWallsAreFilled() {
        page().get("troupe.chooseTheme(false)");
        page().await("(([r]) => r < 20)(" + pixel("[-3.5, 0]") + ")");
        assertThat(page().get("[[-3, 0], [-1.25, -1.25], [4.75, 0], [4, 0], [0, 0]].map(at => (([r]) => r < 20)("
                        + pixel("at") + ")).join()"))
                .as("dark: middle of the cross, the corner, hole with a bar; floor: hole, inside")
                .isEqualTo("true,true,true,false,false");
    }

    /** Whether an obstacle of the picture is filled on its diagonal, at a part of it. */
    private static String isFilled(String name, double part) {
        return page().get("(path => { const box = path.getBBox();"
                + " const to = document.createElementNS('http://www.w3.org/1999/xhtml', 'canvas').getContext('2d');"
                + " return to.isPointInPath(new Path2D(path.getAttribute('d')), box.x + box.width * " + part
                + ", box.y + box.height * " + (1 - part) + ", getComputedStyle(path).fillRule); })"
                + "([...document.querySelectorAll('path')].find(path => path.textContent === '" + name + "'))");
    }

    @Test
    void devicesOfASelectedRobot_areShown_onThePageAndInAFile() throws Exception {
        List<Snapshot> snapshots = DeviceRoom.run();
        Path html = folder.resolve("devices.html");
        var file = new ViewFile();
        try (var view = LiveView.open(LiveView.Settings.defaults().withPort(0))) {
            var viewed = new ViewedRun(DeviceRoom.WORLD, new RunControl(0, false))
                    .onto(view)
                    .onto(file);
            viewed.moved(snapshots.getFirst());
            open(view);
            page().get("(troupe.chooseTheme(false), troupe.select(0))");
            page().await("troupe.view.selected.size === 1 && troupe.model.devices.has(0)");
            awaitFigures("markers", "7, 17");
            awaitFigures("bumpers", "1 of 2 pressed");
            awaitFigures("gripper", "open");
            page().get("(window.texts = new Set(), window.fillText = troupe.view.context.fillText,"
                    + " troupe.view.context.fillText = function (text, ...at) {"
                    + " texts.add(text); return fillText.call(this, text, ...at); })");
            page().await("texts.has('7') && texts.has('17') && !texts.has('?')");
            assertThat(page().get("troupe.view.markers(troupe.model.frame, 0).map(({to}) =>"
                            + " to.map(each => each.toFixed(2)).join(' ')).join()"))
                    .as("where the thing and the lamp are")
                    .isEqualTo("0.25 0.09,2.00 -0.80");
            page().await(isAlarm(0.2));
            page().await("!" + isAlarm(-0.2));

            snapshots.subList(1, 42).forEach(viewed::moved);
            awaitFigures("gripper", "closed, holds thing");
            awaitFigures("bumpers", "free");
            page().await("!" + isAlarm(0.2));
            var picture = (DeviceReading.Picture)
                    snapshots.get(41).robots().getFirst().devices().getLast();
            String image = "document.querySelector('#images canvas')";
            page().await(image + "?.width === 40 && " + image + ".height === 30");
            for (int[] at : new int[][] {{0, 0}, {0, 29}, {5, 15}, {20, 15}, {20, 2}, {39, 15}}) {
                page().await("(([r, g, b]) => (r << 16) + (g << 8) + b)("
                        + pixel(image, "[" + at[0] + ", " + at[1] + "]") + ") === " + picture.colour(at[0], at[1]));
            }
            page().get("(troupe.view.zoom(2.6), troupe.view.x = 0.9, troupe.view.y = 0.3)");
            picture("watching-devices.png");
            page().get("troupe.view.fit()");

            snapshots.subList(42, snapshots.size()).forEach(viewed::moved);
            awaitFigures("bumpers", "1 of 2 pressed");
            page().await(isAlarm(-0.2) + " && !" + isAlarm(0.2));
            page().get("(texts.clear(), troupe.select(1))");
            page().await("troupe.model.devices.has(1) && !troupe.model.devices.has(0)");
            page().await("texts.has('?')");
            page().await("!document.querySelector('#figures').textContent.includes('gripper') && "
                    + "document.querySelector('#images').children.length === 0");
            Files.writeString(html, file.html());
        }
        page().open(html.toUri().toString());
        page().await("troupe.source.frames.length === 96");
        page().get("troupe.select(0)");
        awaitFigures("bumpers", "1 of 2 pressed");
        page().get("troupe.source.seek(4)");
        awaitFigures("gripper", "closed, holds thing");
        assertThat(
                        page().get(
                                        "(model => { model.nextDevices = {number: 4, robots: new Map([[0, {}]])};"
                                                + " model.setReadings({number: 5, readings: new Map()}); return model.devices.size; })(new Model())"))
                .as("devices of an older frame")
                .isEqualTo("0");
    }

    private static void awaitFigures(String name, String text) {
        page().await("[...document.querySelectorAll('#figures dt')].some(each => each.textContent === '" + name
                + "' && each.nextSibling.textContent === '" + text + "')");
    }

    /** Whether a bumper of the first robot, so far ahead of its middle, is drawn as pressed. */
    private static String isAlarm(double aheadM) {
        return "(([r, g, b]) => Math.abs(r - 0xb3) + Math.abs(g - 0x26) + Math.abs(b - 0x1e) < 30)("
                + pixel("WorldCanvas.placer(troupe.model.frame, 0)(" + aheadM + ", 0.06)") + ")";
    }

    @Test
    void page_withoutDevices_hasNothingOfThem() throws Exception {
        try (var run = run(5)) {
            open(run.page);
            page().await("troupe.model.readings.size === 2 && !document.querySelector('#details').hidden");
            page().await("document.querySelector('#figures').textContent.includes('nearest wall')");
            assertThat(page().get("document.querySelector('#figures').textContent"))
                    .doesNotContain("markers", "bumpers", "gripper");
            assertThat(page().get("troupe.model.nextDevices")).isIn("", "null");
        }
    }

    @Test
    void whatIsTakenOut_isNotDrawn() throws Exception {
        try (var world = World.create(LiveRuns.ARENA.world(), WorldSettings.defaults());
                var view = LiveView.open(LiveView.Settings.defaults().withPort(0))) {
            var viewed = new ViewedRun(LiveRuns.ARENA.world(), new RunControl(0, false)).onto(view);
            viewed.moved(world.latest());
            open(view);
            page().await("troupe.view.still?.size > 0 && troupe.view.stillWithout === ''");
            world.removeObstacle(0);
            world.removeRobot(1);
            viewed.moved(world.advance());
            page().await("troupe.model.frame.obstacles.get(0) === null && troupe.view.stillWithout === '0'");
            page().await("document.querySelector('#robots').textContent.includes('not in the world')");
            world.placeObstacle(0, LiveRuns.ARENA.world().obstacles().getFirst().pose());
            viewed.moved(world.advance());
            page().await("troupe.model.frame.obstacles.size === 0 && troupe.view.stillWithout === ''");
        }
    }

    @Test
    void reader_acceptsAnyCutting_andAnyBytes_withoutMoreThanAnError() throws Exception {
        List<byte[]> messages = new ArrayList<>();
        var world = new ViewedWorld(LiveRuns.ARENA.world(), List.of("a"), List.of());
        try (var simulation = Simulation.open(LiveRuns.atOwnPort(LiveRuns.ARENA), WorldSettings.defaults())) {
            Snapshot snapshot = simulation.tick();
            var frame = new ViewFrame(7, snapshot, new short[] {1, (short) 255}, 1.5);
            messages.add(ViewMessages.text(ViewMessages.WORLD, world.json()));
            messages.add(ViewMessages.frame(world, frame, false));
            messages.add(ViewMessages.sensors(frame, List.of(0, 1, 9)));
            var push = new ViewedWorld(PushedBox.WORLD, List.of(), List.of());
            var pushed = new ViewFrame(8, PushedBox.run().getLast(), new short[] {0}, 0);
            messages.add(ViewMessages.frame(push, pushed, false));
            messages.add(ViewMessages.text(99, "of a later version"));
            messages.add(ViewMessages.text(ViewMessages.EVENTS, "[{\"kind\":\"é\\u0000\"}]"));
        }
        StringBuilder bytes = new StringBuilder("[");
        messages.forEach(message -> {
            for (byte each : message) {
                bytes.append(each & 0xFF).append(',');
            }
        });
        try (var view = LiveView.open(LiveView.Settings.defaults().withPort(0))) {
            page().open(view.address());
            page().await("typeof Messages === 'object'");
            page().get("window.bytes = new Uint8Array(" + bytes + "])");
            page().get(
                            "window.read = cut => { const got = []; const push = Messages.reader((type, value) =>"
                                    + " got.push([type, JSON.stringify(value, (k, v) => v instanceof Map ? [...v] : v)]));"
                                    + " for (let i = 0; i < bytes.length; i += cut) push(bytes.slice(i, i + cut)); return JSON.stringify(got); }");
            String whole = page().get("read(1 << 20)");
            assertThat(whole).contains("paper arena", "[2,", "[3,", "[4,").doesNotContain("later version");
            for (int cut : new int[] {1, 2, 3, 5, 7, 64, 1000}) {
                assertThat(page().get("read(" + cut + ") === read(1 << 20)"))
                        .as("pieces of %d bytes", cut)
                        .isEqualTo("true");
            }
            page().get(
                            "window.random = (seed => () => (seed = seed * 1103515245 + 12345 & 0x7fffffff) / 0x7fffffff)(20260)");
            page().get("window.fuzz = () => { let errors = 0; for (let round = 0; round < 3000; round++) {"
                    + " const copy = bytes.slice(); for (let i = 0; i < 1 + random() * 8; i++)"
                    + " copy[Math.floor(random() * copy.length)] = Math.floor(random() * 256);"
                    + " try { Messages.reader(() => {})(copy.slice(0, Math.floor(random() * copy.length))); }"
                    + " catch (error) { if (!(error instanceof Error)) throw error; errors++; } } return errors; }");
            assertThat(page().number("fuzz()"))
                    .as("broken streams that ended with an error")
                    .isPositive();
        }
    }

    @Test
    void everyControl_hasALabel_canBeReachedByKeys_andHasEnoughContrast() throws Exception {
        try (var run = run(1)) {
            open(run.page);
            page().await("document.querySelectorAll('#robots button').length === 2");
            assertThat(page().get("[...document.querySelectorAll('button, select, input, canvas')]"
                            + ".filter(each => each.offsetParent !== null)"
                            + ".filter(each => !(each.getAttribute('aria-label') || each.textContent.trim()"
                            + " || each.labels?.length)).map(each => each.id || each.outerHTML).join()"))
                    .as("controls without a label")
                    .isEmpty();
            assertThat(page().get("document.documentElement.lang")).isEqualTo("en");
            assertThat(page().get("document.querySelectorAll('[tabindex]:not([tabindex=\"0\"])').length"))
                    .isEqualTo("0");
            for (String theme : List.of("false", "true")) {
                page().get("troupe.chooseTheme(" + theme + ")");
                assertThat(page().get(LOW_CONTRASTS))
                        .as("texts with a contrast below 4.5, dark: %s", theme)
                        .isEmpty();
            }
            page().press(ESCAPE);
            page().await("troupe.view.selected.size === 0");
            page().press('0');
            page().press(' ');
            page().await("troupe.paused");
            page().press('.');
            page().await("troupe.view.fitted");
            page().size(500, 900);
            page().await("document.documentElement.scrollWidth <= window.innerWidth");
            picture("watching-phone.png");
        }
    }

    /** The elements whose text has a colour that is too near to that of what is behind it. */
    private static final String LOW_CONTRASTS = """
            (() => {
              const parse = text => text.match(/[\\d.]+/g).map(Number);
              const light = ([r, g, b]) => [r, g, b].map(each => each / 255)
                .map(each => each <= 0.04045 ? each / 12.92 : ((each + 0.055) / 1.055) ** 2.4)
                .reduce((sum, each, i) => sum + each * [0.2126, 0.7152, 0.0722][i], 0);
              const behind = each => { for (; each; each = each.parentElement) {
                const colour = parse(getComputedStyle(each).backgroundColor);
                if (colour.length < 4 || colour[3] > 0) return colour; } return [255, 255, 255]; };
              return [...document.querySelectorAll('body *')]
                .filter(each => each.offsetParent !== null && !each.disabled
                  && [...each.childNodes].some(node => node.nodeType === 3 && node.textContent.trim()))
                .filter(each => { const [a, b] = [light(parse(getComputedStyle(each).color)), light(behind(each))];
                  return (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05) < 4.5; })
                .map(each => each.id || each.className || each.textContent).join();
            })()""";

    @Test
    void servedWorld_waitsForClients_untilThereIsOne_andWhenItIsGone() throws Exception {
        var arena = LiveRuns.atOwnPort(LiveRuns.ARENA);
        try (var simulation = Simulation.open(arena, WorldSettings.defaults());
                var view = LiveView.open(LiveView.Settings.defaults().withPort(0))) {
            simulation.lockStep(false);
            var control = new SimulationControl(simulation, 1);
            var viewed = new ViewedRun(LiveRuns.ARENA.world(), new RunControl(0, false)).onto(view, control);
            viewed.moved(simulation.latest());
            String rate = "document.querySelector('#rate').textContent";
            try (var runner = SimulationRunner.start(simulation, 1, viewed::moved, new Pace.RealTime(1))) {
                control.runner(runner);
                open(view);
                page().await(rate + " === 'waits for clients'");
                var client = new PlayerClient("localhost", arena.robotPort().orElseThrow());
                try {
                    client.requestInterfacePosition2D(0, PlayerConstants.PLAYER_OPEN_MODE);
                    client.runThreaded(-1, -1);
                    page().await(rate + ".endsWith(' x real time')");
                } finally {
                    client.close();
                }
                page().await(rate + " === 'waits for clients'");
            }
        }
    }

    @Test
    void worldThatCanOnlyBeWatched_hasNoControlsOfTime_andSaysWhy() throws Exception {
        try (var view = LiveView.open(LiveView.Settings.defaults().withPort(0))) {
            new ViewedRun(LiveRuns.ARENA.world(), LiveRuns.TABLE, new RunControl(0, false))
                    .onto(view, ViewControl.NONE)
                    .moved(LiveRuns.start());
            open(view);
            page().await("document.querySelector('footer').innerText.trim() === 'can only be watched'");
            assertThat(page().get("[...document.querySelectorAll('footer button, footer select, #box, #box-colour')]"
                            + ".every(each => each.offsetParent === null)"))
                    .isEqualTo("true");
        }
    }

    @Test
    void office_isShown() throws Exception {
        Path world = LiveRuns.WORLDS.resolve("office.cfg");
        var scenario = LiveRuns.atOwnPort(ScenarioReader.read(world));
        try (var simulation = Simulation.open(scenario, WorldSettings.defaults());
                var view = LiveView.open(LiveView.Settings.defaults().withPort(0))) {
            var viewed = new ViewedRun(scenario.world(), new RunControl(0, false)).onto(view);
            simulation.world().command(0, 0.4, 0.1);
            viewed.moved(simulation.latest());
            for (int i = 0; i < 60; i++) {
                viewed.moved(simulation.tick());
            }
            open(view);
            page().get("troupe.select(0)");
            page().await("troupe.model.readings.has(0)");
            picture("watching-office.png");
        }
    }
}
