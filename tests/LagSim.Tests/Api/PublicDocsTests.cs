using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Reflection;
using System.Text.RegularExpressions;
using System.Xml.Linq;
using LagSim.Build;
using Xunit;

namespace LagSim.Tests.Api;

/// <summary>The documentation that the packages have beside their libraries is that of what a user can call, each member's once.</summary>
public sealed class PublicDocsTests
{
    private const BindingFlags All = BindingFlags.DeclaredOnly | BindingFlags.Instance | BindingFlags.Static | BindingFlags.Public | BindingFlags.NonPublic;

    [Theory]
    [InlineData("LagSim")]
    [InlineData("LagSim.Net")]
    [InlineData("LagSim.Net.LiteNetLib")]
    [InlineData("LagSim.Net.Secure")]
    [InlineData("LagSim.Net.WebSockets")]
    [InlineData("LagSim.Testing")]
    public void Documentation_OfAPackage_IsOfItsPublicMembersAlone(string package)
    {
        Assembly library = Assembly.Load(package);
        string docs = File.ReadAllText(Path.ChangeExtension(library.Location, ".xml"));
        Assert.Empty(Faults(library, docs));
        Assert.All(library.GetExportedTypes(), type => Assert.Contains($"\"T:{type.FullName!.Replace('+', '.')}\"", docs, StringComparison.Ordinal));
    }

    /// <summary>The folder for Unity has that of the other framework.</summary>
    [Theory]
    [InlineData("LagSim")]
    [InlineData("LagSim.Net")]
    public void Documentation_InTheFolderForUnity_IsOfPublicMembersAlone(string library)
    {
        string configuration = Path.GetFileName(Path.GetDirectoryName(AppContext.BaseDirectory.TrimEnd('/', '\\')))!;
        string folder = Path.Combine(RepositoryRoot.Path, "src", "LagSim.Unity", "bin", configuration, "package", "Runtime");
        Assert.Empty(Faults(Assembly.Load(library), File.ReadAllText(Path.Combine(folder, $"{library}.xml"))));
    }

    /// <summary>The controls: an internal type, internal and private members of public ones, an internal overload, a member told of twice.</summary>
    [Theory]
    [InlineData("T:LagSim.RuleCaller", "")]
    [InlineData("P:LagSim.Simulation.Engine", "")]
    [InlineData("M:LagSim.Simulation.Nothing", "")]
    [InlineData("M:LagSim.Simulation.AdvanceTo(LagSim.Nothing)", "")]
    [InlineData("T:LagSim.Simulation", "<summary/>")]
    public void Documentation_OfMore_IsSeen(string member, string more)
    {
        Assembly library = typeof(Simulation).Assembly;
        XDocument docs = XDocument.Load(Path.ChangeExtension(library.Location, ".xml"));
        docs.Descendants("member").First().AddBeforeSelf(XElement.Parse($"<member name='{member}'><summary/>{more}</member>"));
        Assert.Single(Faults(library, docs.ToString()));
    }

    [Fact]
    public void Prune_OfDocumentationAsTheCompilerWritesIt_LeavesWhatIsPublic()
    {
        const string Head = "<?xml version=\"1.0\"?>\n<doc>\n    <members>\n", Kept = "        <member name=\"M:A.B(System.Int32@)\">\n            <summary>C</summary>\n        </member>\n",
            Gone = "        <member name=\"T:D\">\n            <summary>E</summary>\n        </member>\n", Tail = "    </members>\n</doc>\n";
        Dictionary<string, bool> members = new() { ["M:A.B(System.Int32@)"] = true, ["T:D"] = false };
        Assert.Equal(Head + Kept + Tail, PublicDocs.Prune(members, Head + Kept + Gone + Tail));
        Assert.Equal(Head + Kept + Kept + Tail, PublicDocs.Prune(members, Head + Gone + Kept + Gone + Gone + Kept + Tail));
        Assert.Equal(Head + Kept + Tail, PublicDocs.Prune(members, Head + Kept + Tail));
        Assert.Contains(
            "'T:F' is documented", Assert.Throws<InvalidDataException>(() => PublicDocs.Prune(members, Head + Gone.Replace("T:D", "T:F", StringComparison.Ordinal) + Tail)).Message, StringComparison.Ordinal);
    }

    /// <summary>Members that are not public, and such as have several summaries; without the step of the build that takes the former away.</summary>
    private static string[] Faults(Assembly library, string docs)
    {
        XElement[] members = [.. XDocument.Parse(docs).Descendants("member")];
        string[] names = [.. members.Select(member => member.Attribute("name")!.Value)];
        return
        [
            .. names.Where(name => name[0] == 'T' && TypeOf(library, name[2..]) is not { IsVisible: true }),
            .. names.Where(name => name[0] != 'T').GroupBy(name => Parameters().Replace(name, "")).Where(all => all.Count() > Visible(library, all.Key)).Select(all => all.Key),
            .. members.Where(member => member.Elements("summary").Count() > 1).Select(member => member.Attribute("name")!.Value),
        ];
    }

    /// <summary>How many overloads of a member others can use.</summary>
    private static int Visible(Assembly library, string member)
    {
        int point = member.LastIndexOf('.');
        string name = member[(point + 1)..].Replace('#', '.');
        return TypeOf(library, member[2..point]) is { IsVisible: true } type ? type.GetMember(name, All).Count(IsVisible) : 0;
    }

    private static bool IsVisible(MemberInfo member) => member switch
    {
        FieldInfo field => field.IsPublic || field.IsFamily || field.IsFamilyOrAssembly,
        MethodBase method => method.IsPublic || method.IsFamily || method.IsFamilyOrAssembly,
        PropertyInfo property => property.GetAccessors(nonPublic: true).Any(IsVisible),
        EventInfo raised => IsVisible(raised.AddMethod!),
        _ => false,
    };

    private static Type? TypeOf(Assembly library, string name)
    {
        Type? type = library.GetType(name);
        for (int point = name.LastIndexOf('.'); type is null && point > 0; point = name.LastIndexOf('.', point - 1))
        {
            type = library.GetType($"{name[..point]}+{name[(point + 1)..].Replace('.', '+')}");
        }

        return type;
    }

    private static Regex Parameters() => new(@"(``[0-9]+)?(\(.*)?(~.*)?$");
}
