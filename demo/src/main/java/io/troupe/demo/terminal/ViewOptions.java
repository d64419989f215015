package io.troupe.demo.terminal;

import io.troupe.view.live.LiveView;
import java.io.IOException;
import java.io.PrintWriter;
import java.net.InetAddress;
import java.net.UnknownHostException;
import org.jspecify.annotations.Nullable;
import picocli.CommandLine.Help.Visibility;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.ParameterException;
import picocli.CommandLine.Spec;

/** Command line options for the live page. */
public final class ViewOptions {
    @Spec(Spec.Target.MIXEE)
    private CommandSpec spec;

    @Option(
            names = "--view",
            paramLabel = "PORT",
            arity = "0..1",
            fallbackValue = "" + LiveView.PORT,
            description = "show the world on a page for browsers, at port " + LiveView.PORT
                    + " unless another one is given; 0 = any that is free",
            showDefaultValue = Visibility.NEVER)
    private @Nullable Integer port;

    @Option(
            names = "--view-bind",
            paramLabel = "ADDRESS",
            description =
                    "the address at which the page listens; one that other hosts reach gets a token, without which nothing is answered",
            showDefaultValue = Visibility.NEVER)
    private @Nullable String bind;

    /** Whether there is to be a page. */
    public boolean isGiven() {
        return port != null;
    }

    /** Opens the page and prints its address; null if there is to be none. */
    public @Nullable LiveView open() throws IOException {
        if (port == null) {
            if (bind != null) {
                throw wrong("--view-bind is " + bind + ", but there is no page: expected --view as well");
            }
            return null;
        }
        if (port < 0 || port > 65_535) {
            throw wrong("--view is " + port + ", expected a port from 0 to 65535");
        }
        var settings = LiveView.Settings.defaults().withPort(port);
        LiveView page = LiveView.open(bind == null ? settings : settings.withAddress(address(bind)));
        PrintWriter terminal = spec.commandLine().getOut();
        terminal.println("watch it at " + page.address());
        terminal.flush();
        return page;
    }

    private InetAddress address(String name) {
        try {
            return InetAddress.getByName(name);
        } catch (UnknownHostException e) {
            throw wrong("--view-bind is " + name + ", expected an address of this machine");
        }
    }

    private ParameterException wrong(String problem) {
        return new ParameterException(spec.commandLine(), problem);
    }
}
