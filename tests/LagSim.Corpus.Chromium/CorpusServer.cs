using System;
using System.IO;
using System.Linq;
using System.Threading.Tasks;
using Microsoft.AspNetCore.Builder;
using Microsoft.AspNetCore.Hosting;
using Microsoft.AspNetCore.Http;
using Microsoft.AspNetCore.StaticFiles;
using Microsoft.Extensions.FileProviders;
using Microsoft.Extensions.Logging;

namespace LagSim.Corpus.Chromium;

/// <summary>Serves the page and two folders of recordings, on the loopback interface. <c>/corpus/</c> is the list of names in it.</summary>
internal sealed class CorpusServer : IAsyncDisposable
{
    /// <summary>Under which name the recordings are.</summary>
    internal const string Corpus = "corpus";

    /// <summary>Under which name those are of which one is changed.</summary>
    internal const string Spoiled = "spoiled";

    private readonly WebApplication application;

    private CorpusServer(WebApplication application) => this.application = application;

    /// <summary>Its address, which ends with a slash.</summary>
    internal string Address => $"{application.Urls.Single()}/";

    public ValueTask DisposeAsync() => application.DisposeAsync();

    /// <summary>Begins to serve, on a port that is free.</summary>
    internal static async Task<CorpusServer> StartAsync(string page, string corpus, string spoiled)
    {
        WebApplicationBuilder builder = WebApplication.CreateSlimBuilder();
        builder.Logging.ClearProviders();
        builder.WebHost.UseUrls("http://127.0.0.1:0");
        WebApplication application = builder.Build();
        FileExtensionContentTypeProvider types = new();
        types.Mappings[".mjs"] = "text/javascript";
        types.Mappings[".lagsim"] = "application/octet-stream";
        types.Mappings[".pdb"] = "application/octet-stream";
        Give(application, "", page, types);
        Give(application, $"/{Corpus}", corpus, types);
        Give(application, $"/{Spoiled}", spoiled, types);
        await application.StartAsync();
        return new CorpusServer(application);
    }

    private static void Give(WebApplication application, string path, string folder, FileExtensionContentTypeProvider types)
    {
        PhysicalFileProvider files = new(Path.GetFullPath(folder));
        application.UseStaticFiles(new StaticFileOptions { RequestPath = path, FileProvider = files, ContentTypeProvider = types });
        if (path.Length > 0)
        {
            application.MapGet($"{path}/", () => Results.Json(files.GetDirectoryContents("").Select(file => file.Name).ToArray()));
        }
    }
}
