package io.troupe.demo.table;

import io.troupe.demo.terminal.FileProblems;
import io.troupe.services.subsumption.ServiceCatalogue;
import io.troupe.services.subsumption.ServiceJar;
import io.troupe.services.subsumption.SubsumptionTable;
import io.troupe.services.subsumption.SubsumptionTableReader;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import org.jspecify.annotations.Nullable;
import picocli.CommandLine.Help.Visibility;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.ParameterException;
import picocli.CommandLine.Spec;

/** The option {@code --services-jar}. The jars stay open until this is closed. */
public final class ServiceJars implements AutoCloseable {
    @Spec(Spec.Target.MIXEE)
    private CommandSpec spec;

    @Option(
            names = "--services-jar",
            paramLabel = "JAR",
            description =
                    "kinds of services for the table to name, from a jar with a ServiceKinds in META-INF/services, or"
                            + " from a directory of classes; may be given several times",
            showDefaultValue = Visibility.NEVER)
    private List<Path> jars = new ArrayList<>();

    private final List<ServiceJar> open = new ArrayList<>();

    /**
     * The services that a table may name: the standard ones and those of the jars.
     *
     * @param table to be read; null if there is none, and then a jar is rejected
     */
    public ServiceCatalogue catalogue(@Nullable Path table) {
        if (table == null && !jars.isEmpty()) {
            throw new ParameterException(
                    spec.commandLine(),
                    "--services-jar is " + jars.getFirst() + ", but there is no table that names its kinds of"
                            + " services: expected a table as well");
        }
        ServiceCatalogue catalogue = ServiceCatalogue.standard();
        for (Path jar : jars) {
            var opened = ServiceJar.open(jar);
            open.add(opened);
            catalogue = opened.addTo(catalogue);
        }
        return catalogue;
    }

    /** Reads a table, which may be one of the installation, with such services. */
    public static SubsumptionTable read(CommandSpec spec, Path table, ServiceCatalogue catalogue) {
        return SubsumptionTableReader.read(FileProblems.input(spec, table, "the text of a table"), catalogue);
    }

    @Override
    public void close() {
        open.forEach(ServiceJar::close);
        open.clear();
    }
}
