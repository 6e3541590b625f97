using System.Linq;
using Xunit;

namespace LagSim.Tests.Scenes;

/// <summary>What is refused, each with its exact place.</summary>
public sealed class SceneFileRefusalTests
{
    [Theory]
    [InlineData("""{"bodies": 1}""", "bodies", "it is 1; it must be an array of objects")]
    [InlineData("""{"name": "s"}""", "format", "this required key is missing")]
    [InlineData("""{"format": "lagsim-scene-1"}""", "name", "this required key is missing")]
    [InlineData("""{"format": "lagsim-scene-2", "name": "s"}""", "format", "\"lagsim-scene-2\"; this version reads \"lagsim-scene-1\" only")]
    [InlineData("""{"format": 1, "name": "s"}""", "format", "it is 1; it must be a string")]
    [InlineData("""{"format": null}""", "format", "it is null; it must be a string")]
    [InlineData("[]", "", "the document is an array; it must be an object")]
    [InlineData("17", "", "the document is 17; it must be an object")]
    [InlineData("{\"colour\": 1}", "colour", "unknown key; allowed are format, name, gravity_m_per_s2, resolution_m")]
    [InlineData("""{"name": "s", "name": "s"}""", "name", "twice")]
    [InlineData("""{"name": "s", "n\u0061me": "s"}""", "name", "twice")]
    [InlineData("""{"format": "lagsim-scene-1", "name": "s"} {}""", "", "not valid JSON")]
    [InlineData("""{"format": "lagsim-scene-1", "name": """, "name", "not valid JSON")]
    [InlineData("""{"format": "lagsim-scene-1" "name": "s"}""", "format", "not valid JSON")]
    public void Parse_WrongDocument_NamesThePlace(string json, string path, string says) => SceneText.Refuses(json, path, says);

    [Theory]
    [InlineData("\"gravity_m_per_s2\": -9.81", "gravity_m_per_s2", "it is -9.81; it must be an array of three numbers")]
    [InlineData("\"gravity_m_per_s2\": [0, -9.81]", "gravity_m_per_s2", "has 2 elements")]
    [InlineData("\"gravity_m_per_s2\": [0, -9.81, 0, 0]", "gravity_m_per_s2[3]", "a fourth element")]
    [InlineData("\"gravity_m_per_s2\": [0, \"a\", 0]", "gravity_m_per_s2[1]", "it is the string \"a\"; it must be a number")]
    [InlineData("\"gravity_m_per_s2\": [0, true, 0]", "gravity_m_per_s2[1]", "it is true; it must be a number")]
    [InlineData("\"gravity_m_per_s2\": [0, 1e7, 0]", "gravity_m_per_s2", "within +-1000000 m/s^2")]
    [InlineData("\"resolution_m\": 1", "resolution_m", "must lie between 1E-15 and 0.001 m")]
    [InlineData("\"resolution_m\": {}", "resolution_m", "it is an object; it must be a number")]
    [InlineData(
        "\"contact_tolerance_m\": 9e-10", "contact_tolerance_m",
        "The contact tolerance of scene 's' is 9E-10; it must lie between 1E-09 and 0.1 m")]
    [InlineData("\"contact_tolerance_m\": 0.11", "contact_tolerance_m", "must lie between 1E-09 and 0.1 m")]
    [InlineData("\"contact_tolerance_m\": 0", "contact_tolerance_m", "must lie between 1E-09 and 0.1 m")]
    [InlineData("\"contact_tolerance_m\": NaN", "contact_tolerance_m", "NaN and infinity are refused everywhere")]
    [InlineData("\"contact_tolerance_m\": \"1 mm\"", "contact_tolerance_m", "it is the string \"1 mm\"; it must be a number")]
    [InlineData("\"smallest_radius_m\": 1e-10", "smallest_radius_m", "must lie between 1E-09 and 1000000000 m")]
    [InlineData("\"smallest_radius_m\": 0.51, \"bodies\": [" + SceneText.Ball + "]", "", "is 0.5 m; the smallest radius of the scene is 0.51 m, and must be at most that of every body")]
    [InlineData("\"periodic_box_m\": [0, 10, 10]", "periodic_box_m", "The periodic box of scene 's' is (0, 10, 10) m; every side must be above zero")]
    [InlineData("\"periodic_box_m\": [10, 10, 10]", "", "has a periodic box, gravity (0, -9.81, 0) m/s^2, ")]
    [InlineData("\"planes\": [1]", "planes[0]", "it is 1; it must be an object")]
    [InlineData("\"planes\": {}", "planes", "it is an object; it must be an array of objects")]
    [InlineData("\"planes\": [{}]", "planes[0].name", "missing")]
    [InlineData("\"planes\": [{\"name\": \"p\", \"point_m\": [0, 0, 0]}]", "planes[0].normal", "missing")]
    [InlineData("\"planes\": [{\"name\": \"p\", \"normal\": [0, 1, 0]}]", "planes[0].point_m", "exactly one; none stands here")]
    [InlineData(
        "\"planes\": [{\"name\": \"p\", \"normal\": [0, 1, 0], \"point_m\": [0, 0, 0], \"offset_m\": 0}]", "planes[0].offset_m", "exactly one; both")]
    [InlineData("\"planes\": [{\"name\": \"p\", \"normal\": [0, 0, 0], \"point_m\": [0, 0, 0]}]", "planes[0]", "between 1e-150 and 1e150")]
    [InlineData("\"planes\": [{\"name\": \"p\", \"normal\": [0, 0, 0], \"offset_m\": 1}]", "planes[0]", "The normal of plane 'p' is (0, 0, 0)")]
    [InlineData("\"planes\": [{\"name\": \"p\", \"normal\": [3, 4, 0], \"offset_m\": 2e12}]", "planes[0]", "The offset of plane 'p' is 2000000000000")]
    [InlineData("\"planes\": [{\"name\": \"p\", \"normal\": [1, 1, 1], \"offset_m\": 1.7e308}]", "planes[0]", "1.7E+308")]
    [InlineData(
        "\"planes\": [{\"name\": \"p\", \"normal\": [0, 1, 0], \"offset_m\": 0, \"restitution\": 1.5}]", "planes[0]", "restitution of plane 'p' is 1.5")]
    [InlineData("\"planes\": [{\"nrml\": 1}]", "planes[0].nrml", "unknown key; allowed are name, normal, point_m, offset_m, restitution")]
    [InlineData("\"forces\": [{\"name\": \"f\", \"kind\": \"glue\"}]", "forces[0].kind", "\"glue\" is unknown; allowed are \"linear_drag\"")]
    [InlineData("\"forces\": [{\"name\": \"f\", \"kind\": \"spring\", \"anchor_m\": [0, 0, 0]}]", "forces[0].stiffness_n_per_m", "required of a force of kind \"spring\"")]
    [InlineData("\"forces\": [{\"name\": \"f\", \"kind\": \"magnetic\", \"field_t\": [0, 0, 1], \"charge_c\": 1, \"power\": 2}]", "forces[0].power", "has no such key; it has field_t, charge_c")]
    [InlineData("\"planes\": [{\"name\": \"p\", \"normal\": [0, 1, 0], \"offset_m\": 0, \"friction\": -1}]", "planes[0]", "The friction of plane 'p' is -1; it must lie between 0 and 100")]
    [InlineData(
        "\"forces\": [{\"name\": \"f\", \"kind\": \"central\", \"centre_m\": [0, 0, 1], \"strength_m_per_s2\": 1, \"power\": 0.5}]", "forces[0].power",
        "the power is 0.5; it must be a whole number between -4 and 4")]
    [InlineData("\"forces\": [{\"name\": \"f\", \"kind\": \"linear_drag\", \"coefficient_kg_per_s\": -2}]", "forces[0]", "The coefficient of force 'f' is -2; it must lie between 0 and 1E+30 kg/s")]
    [InlineData("\"forces\": [{\"name\": \"f\", \"kind\": \"quadratic_drag\", \"coefficient_kg_per_m\": -2}]", "forces[0]", "coefficient of force 'f' is -2; it must lie between 0 and 1E+30 kg/m")]
    [InlineData("\"forces\": [{\"name\": \"f\", \"kind\": \"spring\", \"anchor_m\": [0, 2e12, 0], \"stiffness_n_per_m\": 1}]", "forces[0]", "The anchor of force 'f' is (0, 2000000000000, 0); every component must be finite and within +-1000000000000 m.")]
    [InlineData("\"forces\": [{\"name\": \"f\", \"kind\": \"spring\", \"anchor_m\": [0, 0, 0], \"stiffness_n_per_m\": 2e30}]", "forces[0]", "The stiffness of force 'f' is 2E+30; it must lie between 0 and 1E+30 N/m")]
    [InlineData("\"forces\": [{\"name\": \"f\", \"kind\": \"magnetic\", \"field_t\": [0, 0, 1], \"charge_c\": 2e30}]", "forces[0]", "The charge of force 'f' is 2E+30; it must lie between -1E+30 and 1E+30 C")]
    [InlineData("\"forces\": [{\"name\": \"f\", \"kind\": \"magnus\", \"coefficient_kg\": 2e30}]", "forces[0]", "The coefficient of force 'f' is 2E+30; it must lie between -1E+30 and 1E+30 kg.")]
    [InlineData("\"forces\": [{\"name\": \"f\", \"kind\": \"central\", \"centre_m\": [0, 0, 0], \"strength_m_per_s2\": 2e30}]", "forces[0]", "The strength of force 'f' is 2E+30; it must lie between -1E+30 and 1E+30 m/s^2 at 1 m.")]
    [InlineData("\"static_spheres\": [{\"name\": \"a\"}]", "static_spheres[0].centre_m", "missing")]
    [InlineData(
        "\"static_spheres\": [{\"name\": \"a\", \"centre_m\": [0, 2e12, 0], \"radius_m\": 1}]", "static_spheres[0]", "position of static sphere 'a'")]
    [InlineData("\"static_spheres\": [{\"mass_kg\": 1}]", "static_spheres[0].mass_kg", "unknown key; allowed are name, centre_m, radius_m, restitution")]
    public void Parse_WrongPart_NamesThePlace(string keys, string path, string says) => SceneText.Refuses(SceneText.With(keys), path, says);

    [Theory]
    [InlineData("\"radius_m\"", "\"radus_m\"", "bodies[0].radus_m", "unknown key; allowed are name, radius_m, mass_kg, restitution, position_m,")]
    [InlineData("\"radius_m\": 0.5,", "", "bodies[0].radius_m", "missing")]
    [InlineData("\"mass_kg\": 1,", "", "bodies[0].mass_kg", "missing")]
    [InlineData("\"restitution\": 0.8,", "", "bodies[0].restitution", "missing")]
    [InlineData("\"name\": \"ball\",", "", "bodies[0].name", "missing")]
    [InlineData("1,", "1, \"mass_kg\": 1,", "bodies[0].mass_kg", "twice")]
    [InlineData("0.5", "-0.5", "bodies[0]", "The radius of body 'ball' is -0.5; it must lie between 1E-09 and 1000000000 m")]
    [InlineData("0.5", "0", "bodies[0]", "The radius of body 'ball' is 0")]
    [InlineData("1,", "0,", "bodies[0]", "The mass of body 'ball' is 0")]
    [InlineData("0.8", "1.01", "bodies[0]", "The restitution of body 'ball' is 1.01")]
    [InlineData("[0, 10, 0]", "[0, 1e13, 0]", "bodies[0]", "The position of body 'ball'")]
    [InlineData("[0, 10, 0]", "[0, 10, 0], \"velocity_m_per_s\": [1e11, 0, 0]", "bodies[0]", "a tenth of that radius in a tick")]
    [InlineData("[0, 10, 0]", "[0, 10, [0]]", "bodies[0].position_m[2]", "it is an array; it must be a number")]
    [InlineData("0.5", "NaN", "bodies[0].radius_m", "NaN and infinity are refused everywhere")]
    [InlineData("0.5", "nan", "bodies[0].radius_m", "NaN and infinity are refused everywhere")]
    [InlineData("0.5", "Infinity", "bodies[0].radius_m", "NaN and infinity are refused everywhere")]
    [InlineData("0.5", "-Infinity", "bodies[0].radius_m", "NaN and infinity are refused everywhere")]
    [InlineData("0.5", "+Inf", "bodies[0].radius_m", "NaN and infinity are refused everywhere")]
    [InlineData("[0, 10, 0]", "[0, 10, NaN]", "bodies[0].position_m[2]", "NaN and infinity are refused everywhere")]
    [InlineData("0.5", "\"NaN\"", "bodies[0].radius_m", "it is the string \"NaN\"; it must be a number. NaN and infinity are refused")]
    [InlineData("0.5", "\"-Infinity\"", "bodies[0].radius_m", "NaN and infinity are refused everywhere")]
    [InlineData("0.5", "1e999", "bodies[0].radius_m", "the number 1e999 is beyond the range of a double")]
    [InlineData("[0, 10, 0]", "[-1e400, 10, 0]", "bodies[0].position_m[0]", "the number -1e400 is beyond the range of a double")]
    [InlineData("0.5", "\"0.5\"", "bodies[0].radius_m", "it is the string \"0.5\"; it must be a number")]
    [InlineData("0.5", "+0.5", "bodies[0].radius_m", "not valid JSON")]
    [InlineData("0.5", ".5", "bodies[0].radius_m", "not valid JSON")]
    [InlineData("0.5", "0x5", "bodies[0].radius_m", "not valid JSON")]
    [InlineData("0.8", "0.8, \"motion\": \"euler\"", "bodies[0].motion", "\"euler\" is unknown; allowed are \"ballistic\", \"rk4\"")]
    [InlineData("0.8", "0.8, \"motion\": \"RK4\"", "bodies[0].motion", "\"RK4\" is unknown")]
    [InlineData("0.8", "0.8, \"step_s\": 0", "bodies[0].step_s", "the step is 0 s; it must lie between 1E-06 and 1 s")]
    [InlineData("0.8", "0.8, \"step_s\": 1e300", "bodies[0].step_s", "it must lie between 1E-06 and 1 s")]
    [InlineData("0.8", "0.8, \"players\": [17]", "bodies[0].players[0]", "the peer 17 cannot be granted a right; it must be a whole number between 0 and 16")]
    [InlineData("0.8", "0.8, \"players\": [0, 0.5]", "bodies[0].players[1]", "the peer 0.5 cannot be granted a right")]
    [InlineData("0.8", "0.8, \"players\": [3, 3]", "bodies[0].players[1]", "the peer 3 stands here twice")]
    [InlineData("0.8", "0.8, \"players\": 3", "bodies[0].players", "it is 3; it must be an array of the numbers of peers")]
    [InlineData("0.8", "0.8, \"forces\": [\"air\"]", "bodies[0].forces[0]", "no force of the scene is named \"air\"; it has none")]
    [InlineData("0.8", "0.8, \"forces\": [\"air\", \"air\"]", "bodies[0].forces[1]", "the force \"air\" stands here twice")]
    [InlineData("0.8", "0.8, \"friction\": 101", "bodies[0]", "The friction of body 'ball' is 101; it must lie between 0 and 100")]
    [InlineData("0.8", "0.8, \"category\": -1", "bodies[0].category", "is -1; it must be a whole number from 0 to 4294967295")]
    [InlineData("0.8", "0.8, \"mask\": 4294967296", "bodies[0].mask", "is 4294967296; it must be a whole number from 0 to 4294967295")]
    [InlineData("0.8", "0.8, \"mask\": 1.5", "bodies[0].mask", "is 1.5; it must be a whole number")]
    [InlineData("0.8", "0.8, \"mask\": \"0x1\"", "bodies[0].mask", "it is the string \"0x1\"; it must be a number")]
    [InlineData("0.8", "0.8, \"tag\": 18446744073709551616", "bodies[0].tag", "is 18446744073709551616; it must be a whole number")]
    [InlineData("0.8", "0.8, \"rolling_resistance\": 2", "bodies[0]", "The rolling resistance of body 'ball' is 2")]
    [InlineData("0.8", "0.8, \"spin_rad_per_s\": [1e12, 0, 0]", "bodies[0]", "The spin of body 'ball' is (1000000000000, 0, 0) rad/s; at most")]
    [InlineData("0.8", "0.8, \"tolerance\": 2", "bodies[0]", "The tolerance of body 'ball' is 2; it must lie between 0 and 1 m")]
    [InlineData("\"ball\"", "\"\"", "bodies[0].name", "the name has 0 characters; a name has 1 to 64")]
    [InlineData("\"ball\"", "\"a\\u001bb\"", "bodies[0].name", "the control character U+001B")]
    [InlineData("\"ball\"", "\"\\ud800\"", "bodies[0].name", "half of a surrogate pair")]
    [InlineData("\"mass_kg\"", "\"\\udc00\"", "bodies[0]", "half of a surrogate pair")]
    [InlineData("0.8,", "0.8, // bouncy\n", "bodies[0].restitution", "comments are not allowed")]
    [InlineData("0.8,", "/* bouncy */ 0.8,", "bodies[0].restitution", "comments are not allowed")]
    [InlineData("[0, 10, 0]", "[0, 10, 0,]", "bodies[0].position_m[3]", "trailing commas are not allowed")]
    [InlineData("[0, 10, 0]", "[0, 10, 0] , ", "bodies[0].position_m", "trailing commas are not allowed")]
    public void Parse_WrongBody_NamesThePlace(string old, string by, string path, string says) =>
        SceneText.Refuses(SceneText.BallWith(old, by), path, says);

    [Fact]
    public void Parse_SecondBodyWrong_NamesItsIndexAndLine()
    {
        string json = SceneText.With("\n\"bodies\": [\n" + SceneText.Ball + ",\n" + SceneText.Ball.Replace("mass_kg", "mass") + "]");

        Assert.Equal(4, SceneText.Refuses(json, "bodies[1].mass", "(line 4)").Line);
    }

    [Fact]
    public void Parse_TwoPartsOfOneName_NamesIt() =>
        SceneText.Refuses(
            SceneText.With("\"planes\": [" + SceneText.Floor.Replace("floor", "ball") + "], \"bodies\": [" + SceneText.Ball + "]"),
            "",
            "Two parts of scene 's' are named 'ball'");

    [Fact]
    public void Parse_BodiesThatOverlap_NamesBoth() =>
        SceneText.Refuses(
            SceneText.With("\"bodies\": [" + SceneText.Ball + "," + SceneText.Ball.Replace("ball", "twin") + "]"), "", "deep inside body 'twin'");

    [Fact]
    public void Parse_BodyInsideAPlane_NamesBoth() =>
        SceneText.Refuses(SceneText.Valid.Replace("10", "0.25"), "", "Body 'ball' starts 0.25 m deep inside plane 'floor'");

    [Theory]
    [InlineData(2, "it has \"f0\", \"f1\"")]
    [InlineData(13, "it has \"f0\", \"f1\", \"f2\", \"f3\", \"f4\", \"f5\", \"f6\", \"f7\", \"f8\", \"f9\" and 3 more")]
    public void Parse_BodyThatNamesNoForceOfTheScene_SaysWhichThereAre(int count, string there)
    {
        string forces = string.Join(", ", Enumerable.Range(0, count).Select(n => $$"""{"name": "f{{n}}", "kind": "magnus", "coefficient_kg": 1}"""));
        SceneText.Refuses(
            SceneText.With($$"""
                "bodies": [{"name": "b", "radius_m": 1, "mass_kg": 1, "restitution": 1, "position_m": [0, 0, 0], "forces": ["g"]}], "forces": [{{forces}}]
                """),
            "bodies[0].forces[0]", "no force of the scene is named \"g\"; " + there);
    }

    [Fact]
    public void Parse_SpeedTooHighForTheSmallestRadius_NamesTheBody() =>
        SceneText.Refuses(
            SceneText.With("\"smallest_radius_m\": 1e-9, \"bodies\": [" + SceneText.Ball.Replace("[0, 10, 0]", "[0, 10, 0], \"velocity_m_per_s\": [200, 0, 0]") + "]"),
            "",
            "The velocity of body 'ball'");
}
