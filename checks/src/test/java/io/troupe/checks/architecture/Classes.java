package io.troupe.checks.architecture;

import com.tngtech.archunit.core.domain.JavaClasses;
import com.tngtech.archunit.core.importer.ClassFileImporter;
import io.troupe.checks.Repository;
import java.net.URISyntaxException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.function.Predicate;

/**
 * The compiled main classes of the modules, read from the folders of the build that runs this test.
 *
 * <p><b>Role.</b> It reads folders, not the class path. So the module of each class is known, and a module that is not
 * on the class path of {@code checks} is included too.
 */
final class Classes {
    /** Every module but {@code stress}, whose tests are in the packages that they test. */
    static final JavaClasses MAIN = read(module -> !module.equals("stress"));

    static final JavaClasses STRESS = of("stress");

    private Classes() {}

    static JavaClasses of(String module) {
        return read(module::equals);
    }

    private static JavaClasses read(Predicate<String> wanted) {
        var folders = Repository.modules().stream()
                .filter(module -> wanted.test(module.getFileName().toString()))
                .map(module -> module.resolve(outputFolder()))
                .filter(Files::isDirectory)
                .toList();
        return new ClassFileImporter()
                .withImportOption(location -> !location.contains("jmh_generated"))
                .importPaths(folders);
    }

    private static String outputFolder() {
        return compiledByMaven() ? "target/classes" : "build/classes/java/main";
    }

    private static boolean compiledByMaven() {
        try {
            var ownFolder = Path.of(Classes.class
                    .getProtectionDomain()
                    .getCodeSource()
                    .getLocation()
                    .toURI());
            return ownFolder.endsWith("target/test-classes");
        } catch (URISyntaxException impossible) {
            throw new IllegalStateException(impossible);
        }
    }
}
