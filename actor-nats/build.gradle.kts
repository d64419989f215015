description = "The bus of actor-service over hosts, carried by a NATS server"

dependencies {
    api(project(":actor-service"))
    testImplementation(project(":tools"))
    implementation(libs.jnats) {
        exclude(group = "org.bouncycastle", module = "bcprov-lts8on") // only for NKeys; 6 MB with a native library
    }
}

tasks.jar { manifest { attributes("Automatic-Module-Name" to "io.troupe.bus.nats") } }

tasks.test {
    inputs.dir("../docs/examples/python")
    inputs.dir("../docs/hosts")
    providers.systemProperty("troupe.python").orNull?.let { systemProperty("troupe.python", it) }
}
