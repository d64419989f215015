package io.troupe.player;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.ActorSpace;
import io.troupe.player.wire.ScriptedServer;
import java.io.File;
import java.io.IOException;
import java.io.StringWriter;
import java.lang.reflect.Array;
import java.lang.reflect.Method;
import java.lang.reflect.Modifier;
import java.net.URI;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.stream.Collectors;
import java.util.stream.Stream;
import javax.tools.ToolProvider;
import org.jspecify.annotations.NullMarked;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.MethodSource;

/** Programs that javac alone compiles, with only the class path that guide 04 names. */
@Timeout(300)
class UserProgramTest {
    /** The class path of a user program: playerlike-sim, actor-core and JSpecify. */
    private static final List<Class<?>> NAMED_IN_THE_GUIDE =
            List.of(PlayerClient.class, ActorSpace.class, NullMarked.class);

    /** The packages below {@code io.troupe.player.structures}. */
    private static final String STRUCTURES = """
            actarray aio audio audiodsp audiomixer blinkenlight blobfinder bumper camera dio fiducial gps graphics2d \
            graphics3d gripper health imu ir joystick laser limb localize log map mcom opaque planner player \
            pointcloud3d position1d position2d position3d power ptz ranger rfid simulation sonar sound speech \
            speechrecognition stereo waveform wifi wsn""";

    /** Written for javaclient3 except for the import prefix; it mentions the unsupported interfaces too. */
    private static final String MENTIONS_EVERYTHING = """
            import io.troupe.player.*;
            import io.troupe.player.structures.*;
            public class Everything implements PlayerConstants {
                ActarrayInterface arm; AIOInterface aio; AudioInterface audio; AudioDSPInterface dsp;
                AudioMixerInterface mixer; BlinkenlightInterface lamp; BumperInterface bumper; CameraInterface camera;
                DIOInterface dio; FiducialInterface fiducial; GPSInterface gps; Graphics2DInterface g2d;
                Graphics3DInterface g3d; GripperInterface gripper; HealthInterface health; IMUInterface imu;
                IRInterface ir; JoystickInterface joystick; LimbInterface limb; LocalizeInterface localize;
                LogInterface log; MapInterface map; MComInterface mcom; OpaqueInterface opaque;
                PlannerInterface planner; PointCloud3DInterface cloud; Position1DInterface p1; Position3DInterface p3;
                PowerInterface power; PtzInterface ptz; RFIDInterface rfid; SoundInterface sound;
                SpeechInterface speech; SpeechRecognitionInterface ear; StereoInterface stereo;
                WaveformInterface waveform; WiFiInterface wifi; WSNInterface wsn;

                void drive(PlayerClient robot) {
                    bumper = robot.requestInterfaceBumper(0, PLAYER_OPEN_MODE);
                    log = robot.requestInterfaceLog(0, PLAYER_OPEN_MODE);
                    map = robot.requestInterfaceMap(0, PLAYER_OPEN_MODE);
                    ptz = robot.requestInterfacePtz(0, PLAYER_OPEN_MODE);
                    fiducial = robot.requestInterfaceFiducial(0, PLAYER_OPEN_MODE);
                    gripper = robot.requestInterfaceGripper(0, PLAYER_OPEN_MODE);
                    localize = robot.requestInterfaceLocalize(0, PLAYER_OPEN_MODE);
                    planner = robot.requestInterfacePlanner(0, PLAYER_OPEN_MODE);
                    rfid = robot.requestInterfaceRFID(0, PLAYER_OPEN_MODE);
                    dio = robot.requestInterfaceDIO(0, PLAYER_OPEN_MODE);
                    arm = robot.requestInterfaceActarray(0, PLAYER_OPEN_MODE);
                    stereo = robot.requestInterfaceStereo(0, PLAYER_OPEN_MODE);
                    PlayerBumperData hits = bumper.getData();
                    byte[] each = hits.getBumpers();
                    PlayerPtzCmd look = new PlayerPtzCmd();
                    look.setPan(0.5f);
                    ptz.setPTZ(look);
                    for (PlayerFiducialItem item : fiducial.getData().getFiducials())
                        System.out.println(item.getId() + " " + item.getPose().getPyaw());
                    gripper.setGripper(PLAYER_GRIPPER_CMD_OPEN);
                    log.setFileName("run.log");
                    map.requestMapInformation();
                    PlayerMapInfo info = map.getData();
                    PlayerPose2d origin = info.getOrigin();
                    planner.setGoal(new PlayerPose(1, 2, 0));
                    planner.setGoal(new PlayerPose2d(1, 2, 0));
                    PlayerPose[] way = planner.getWaypointData().getWaypoints();
                    PlayerLocalizeHypoth[] where = localize.getData().getHypoths();
                    PlayerRfidTag[] tags = rfid.getData().getTags();
                    dio.setOutputBitfield(8, 1);
                    arm.setPosition(0, 0.5f);
                    p3.setSpeed(0.1, 0);

                    SimulationInterface simulation = robot.requestInterfaceSimulation(0, PLAYER_OPEN_MODE);
                    simulation.get2DPose("robot1");
                    while (!simulation.isPose2DReady());
                    PlayerSimulationPose2dReq pose = simulation.getSimulationPose2D();
                    PlayerSimulationPose3dReq inSpace = simulation.getSimulationPose3D();
                    LaserInterface laser = robot.requestInterfaceLaser(0, PLAYER_OPEN_MODE);
                    double heading = laser.getPlayerLaserGeom().getPose().getPa();
                    robot.nextData().thenAccept(none -> System.out.println(heading));
                }
            }
            """;

    @TempDir
    private Path folder;

    /** Compiles the sources; returns the output of javac, which is empty on success. */
    private String compile(List<Path> sources) throws IOException {
        String classPath = NAMED_IN_THE_GUIDE.stream()
                .map(UserProgramTest::placeOf)
                .distinct()
                .collect(Collectors.joining(File.pathSeparator));
        var options = List.of("-cp", classPath, "-d", folder.resolve("out").toString(), "-proc:none");
        var compiler = ToolProvider.getSystemJavaCompiler();
        var said = new StringWriter();
        try (var files = compiler.getStandardFileManager(null, null, null)) {
            var task = compiler.getTask(said, files, null, options, null, files.getJavaFileObjectsFromPaths(sources));
            return task.call() ? said.toString() : "failed: " + said;
        }
    }

    private static String placeOf(Class<?> type) {
        var place = type.getProtectionDomain().getCodeSource().getLocation();
        return Path.of(URI.create(place.toString())).toString();
    }

    @Test
    void programs_compile_withWhatTheGuideNames() throws IOException {
        try (Stream<Path> programs = Files.list(Path.of("src/test/java/io/troupe/player/programs"))) {
            List<Path> sources = programs.filter(each -> !each.endsWith("package-info.java"))
                    .sorted()
                    .toList();
            assertThat(sources).hasSizeGreaterThan(9);
            assertThat(compile(sources)).isEmpty();
        }
    }

    @Test
    void program_thatMentionsWhatIsNotOffered_compiles() throws IOException {
        String imports = Stream.of(STRUCTURES.split(" "))
                .map(each -> "import io.troupe.player.structures." + each + ".*;\n")
                .collect(Collectors.joining());
        Path source = Files.writeString(folder.resolve("Everything.java"), imports + MENTIONS_EVERYTHING);
        assertThat(compile(List.of(source))).isEmpty();
    }

    static List<Class<?>> unoffered() {
        return Stream.of(UnsupportedInterfaces.class.getDeclaredMethods())
                .filter(each -> each.getName().startsWith("requestInterface"))
                .<Class<?>>map(Method::getReturnType)
                .distinct()
                .toList();
    }

    @ParameterizedTest
    @MethodSource("unoffered")
    void methods_ofAnInterfaceThatIsNotOffered_sayWhatThereIs(Class<?> type) throws Exception {
        try (var port = PlayerPorts.open(ScriptedServer.PORT, new ScriptedServer())) {
            assertThat(port).isNotNull();
            var client = new PlayerClient("localhost", ScriptedServer.PORT);
            Object device = type.getConstructor(PlayerClient.class).newInstance(client);
            var methods = Stream.of(type.getDeclaredMethods())
                    .filter(each -> Modifier.isPublic(each.getModifiers()) && !each.isSynthetic())
                    .toList();
            for (Method method : methods) {
                Object[] arguments = Stream.of(method.getParameterTypes())
                        .map(UserProgramTest::argument)
                        .toArray();
                assertThatThrownBy(() -> method.invoke(device, arguments))
                        .as("%s", method)
                        .cause()
                        .isInstanceOf(PlayerException.class)
                        .hasMessageContaining("is not offered by this client, which has position2d, sonar");
            }
            client.close();
        }
    }

    private static Object argument(Class<?> type) {
        return Array.get(Array.newInstance(type, 1), 0);
    }
}
