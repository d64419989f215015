package io.troupe.common.process;

import java.io.File;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Optional;
import java.util.stream.Stream;

/**
 * Finds programs that are installed on this machine.
 *
 * <p><b>Threads.</b> Any; a look reads the file system.
 */
public final class Programs {
    /**
     * Where packages put servers, which is not on the PATH of a plain user (Debian) or of a desktop program (macOS).
     */
    private static final List<String> FURTHER_FOLDERS =
            List.of("/usr/local/sbin", "/usr/sbin", "/sbin", "/usr/local/bin", "/opt/homebrew/bin");

    private static final boolean IS_WINDOWS = File.separatorChar == '\\';

    private Programs() {}

    /** A program on the PATH; on Windows also {@code NAME.exe}. */
    public static Optional<Path> onPath(String name) {
        String path = System.getenv().getOrDefault("PATH", "");
        return find(name, Stream.of(path.split(File.pathSeparator)), IS_WINDOWS);
    }

    /** A program on the PATH, or in a folder that packages use for servers. */
    public static Optional<Path> find(String name) {
        return onPath(name).or(() -> find(name, FURTHER_FOLDERS.stream(), IS_WINDOWS));
    }

    /** Where {@link #find} looks, for messages. */
    public static String places() {
        return "the PATH, " + String.join(", ", FURTHER_FOLDERS);
    }

    static Optional<Path> find(String name, Stream<String> folders, boolean isWindows) {
        List<String> names = isWindows ? List.of(name, name + ".exe") : List.of(name);
        return folders.flatMap(folder -> names.stream().map(each -> Path.of(folder, each)))
                .filter(file -> Files.isRegularFile(file) && Files.isExecutable(file))
                .findFirst();
    }
}
